"""Loads the Python files of protocols as modules that do not collide, with the files beside them importable.

The name of a module is made of its whole path, so that files of one name are different modules. Files beside
it can be imported while it loads and while a run goes on. Between these they are not in `sys.modules`, where
a file of the same name in another folder would find them.
"""

import hashlib
import importlib.util
import os
import sys
import threading
import time
import uuid
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import lru_cache
from itertools import takewhile
from pathlib import Path
from types import ModuleType
from weakref import WeakValueDictionary

from gradysim.protocol.interface import IProtocol

_loading = threading.RLock()
"""`sys.path` and `sys.modules` are shared by the whole process."""

_SURE_NS = 1_000_000_000

_running = threading.RLock()
"""Held while the files of one scenario are importable during its run."""

_being_loaded: set[Path] = set()
"""Files whose code is running as a module now."""


class BeingLoadedError(ImportError):
    """The code of a file loads that file again, which would never end."""


class ModuleLoader:
    """Loads each file once. Another loader loads the file again.

    Attributes:
        name: Distinguishes loaders, also in other processes.
    """

    def __init__(self, name: str = "") -> None:
        self.name = name or uuid.uuid4().hex
        self._modules: dict[Path, ModuleType] = {}
        self._siblings: dict[Path, dict[str, ModuleType]] = {}
        _loaders[self.name] = self
        importlib.invalidate_caches()

    def load(self, file: Path) -> ModuleType:
        """Return the module of a file. What its code raises is passed on.

        Raises:
            BeingLoadedError: The code of the file itself called this.
        """
        file = file.resolve()
        if file not in self._modules:
            with _loading, self.siblings_importable(file.parent, first=True):
                if file in _being_loaded:
                    raise BeingLoadedError(f"{file} is being loaded already")
                _being_loaded.add(file)
                try:
                    self._modules[file] = _execute(file)
                finally:
                    _being_loaded.remove(file)
        return self._modules[file]

    @contextmanager
    def siblings_importable(self, folder: Path, *, first: bool) -> Iterator[None]:
        """Inside, the files of a folder can be imported. Each of them is loaded once by this loader.

        If they come `first`, files with names of the standard library are found, too, as by a script there.
        No bytecode of them is stored: Python would also use it for a source of the same size that is edited
        within the same second.
        """
        siblings = self._siblings.setdefault(folder, {})
        names = _module_names(folder)
        hidden = {name: module for name, module in _loaded(names) if not _is_in(name, module, folder)}
        for name in hidden:
            del sys.modules[name]
        latest = next(reversed(sys.modules))
        sys.modules.update(
            {name: module for name, module in siblings.items() if first or not _is_stdlib(name)}
        )
        sys.path.insert(0 if first else len(sys.path), str(folder))
        before = sys.dont_write_bytecode
        sys.dont_write_bytecode = True
        try:
            yield
        finally:
            sys.dont_write_bytecode = before
            if str(folder) in sys.path:
                sys.path.remove(str(folder))
            new = list(takewhile(lambda name: name != latest, reversed(sys.modules)))
            for name in reversed(new):
                if _is_in(name, sys.modules[name], folder):
                    siblings[name] = sys.modules.pop(name)
            sys.modules.update(hidden)


def _loaded(names: frozenset[str]) -> list[tuple[str, ModuleType]]:
    """Return the modules with one of these names, and those of packages with one.

    Mostly there are none. Then this looks at no module: each look would copy a page of memory in a process
    that was forked.
    """
    top_level = {name for name in names if name in sys.modules}
    if not top_level:
        return []
    # A list, since looking at a lazy module may import others, and other threads import modules, too.
    return [entry for entry in list(sys.modules.items()) if entry[0].partition(".")[0] in top_level]


_loaders: WeakValueDictionary[str, ModuleLoader] = WeakValueDictionary()


def _execute(file: Path) -> ModuleType:
    digest = hashlib.sha256(os.fsencode(file)).hexdigest()[:12]
    name = f"_gradysim_protocol_{digest}_{file.stem}"
    spec = importlib.util.spec_from_file_location(name, file)
    if spec is None or spec.loader is None:
        raise ImportError(f"{file.name} is not a Python source file")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[name]
        raise
    return module


def _is_stdlib(name: str) -> bool:
    return name.partition(".")[0] in sys.stdlib_module_names


def _module_names(folder: Path) -> frozenset[str]:
    """Return the names of the modules of a folder that hide modules from elsewhere.

    The folder is listed again when it has changed. A change within the last second may go on without a new
    time of change, on systems with coarse clocks.
    """
    try:
        changed_ns = os.stat(folder).st_mtime_ns
        if time.time_ns() - changed_ns < _SURE_NS:
            return _listed(folder)
        return _listed_at(folder, changed_ns)
    except OSError:  # the folder is gone, or was never there
        return frozenset()


@lru_cache(maxsize=64)
def _listed_at(folder: Path, _changed_ns: int) -> frozenset[str]:
    return _listed(folder)


def _listed(folder: Path) -> frozenset[str]:
    entries = list(os.scandir(folder))
    files = {entry.name.removesuffix(".py") for entry in entries if entry.name.endswith(".py")}
    folders = (entry for entry in entries if entry.is_dir())
    packages = {entry.name for entry in folders if os.path.isfile(os.path.join(entry.path, "__init__.py"))}
    return frozenset((files | packages) - sys.stdlib_module_names - {"__main__", "gradysim"})


def _is_in(name: str, module: ModuleType, folder: Path) -> bool:
    """Return whether a module is a file in the folder, or belongs to a package there."""
    top_level, *_ = name.split(".")
    file = getattr(module, "__file__", None)
    if file is None:
        return any(Path(path).parent == folder for path in getattr(module, "__path__", ()) if "." not in name)
    path = Path(file).resolve()
    return path == folder / f"{top_level}.py" or path.is_relative_to(folder / top_level)


_ORIGIN = "_gradysim_origin"
"""The attribute of a class that has its Origin. In a table of classes, these would never be freed."""


@dataclass(frozen=True)
class Origin:
    """Origin of a class. A scenario that goes to another process has it instead of the class.

    Attributes:
        file: The file, with its whole path.
        name: The name of the class in it.
        loader: The loader of the class.
    """

    file: Path
    name: str
    loader: ModuleLoader

    def __reduce__(self) -> tuple[object, ...]:
        return _origin_in_this_process, (self.file, self.name, self.loader.name)

    def load(self) -> type[IProtocol]:
        """Return the class."""
        cls: type[IProtocol] = getattr(self.loader.load(self.file), self.name)
        if origin_of(cls) is None:
            remember_origin(cls, self)
        return cls


def _origin_in_this_process(file: Path, name: str, loader: str) -> Origin:
    return Origin(file, name, _loaders.get(loader) or ModuleLoader(loader))


def remember_origin(cls: type[IProtocol], origin: Origin) -> None:
    """Store the origin of a class. The first one counts."""
    if _ORIGIN not in vars(cls):
        setattr(cls, _ORIGIN, origin)


def origin_of(cls: type[IProtocol]) -> Origin | None:
    """Return the origin of a class; None if it was imported by the name of its module."""
    origin: Origin | None = vars(cls).get(_ORIGIN)
    return origin


@contextmanager
def siblings_importable(classes: Iterable[type[IProtocol]]) -> Iterator[None]:
    """Inside, the files beside those of protocols can be imported, by functions and by pickle.

    A name that several of their folders have cannot be imported. While another thread runs a scenario, only
    the files beside the protocols of that one can be.
    """
    origins = [origin for cls in set(classes) if (origin := origin_of(cls)) is not None]
    folders = {(origin.loader, origin.file.parent) for origin in origins}
    if not folders or not _running.acquire(blocking=False):
        yield
        return
    try:
        with ExitStack() as stack:
            for loader, folder in folders:
                stack.enter_context(loader.siblings_importable(folder, first=False))
            if len(folders) > 1:
                stack.enter_context(_ambiguous_hidden([folder for _, folder in folders]))
            yield
    finally:
        _running.release()


@contextmanager
def _ambiguous_hidden(folders: Iterable[Path]) -> Iterator[None]:
    """Inside, a name that several folders have cannot be imported."""
    counts = Counter(name for folder in folders for name in _module_names(folder))
    ambiguous = [name for name, count in counts.items() if count > 1]
    for name in ambiguous:
        sys.modules[name] = None  # type: ignore[assignment]  # which makes the import fail
    try:
        yield
    finally:
        for name in ambiguous:
            sys.modules.pop(name, None)
