"""Loads the Python file of a protocol, as a module that collides with no other.

The module's name is made of its whole path, so that files of one name are different modules. While it loads,
and while a run goes on (see siblings), its folder is importable, for sibling files. These siblings are shared
by the protocols of that folder only: afterwards they are taken out of `sys.modules`, where a sibling of the
same name in another folder would find them.
"""

import hashlib
import importlib
import importlib.util
import os
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from pathlib import Path
from types import CodeType, ModuleType

_lock = threading.RLock()
"""`sys.path` and `sys.modules` belong to the whole process."""

_being_loaded: set[Path] = set()
"""Files whose code is running as that of a module now. It belongs to who holds the lock."""


class BeingLoadedError(ImportError):
    """The code of a file leads to loading that file, which would never end.

    Attributes:
        file: The file.
    """

    def __init__(self, file: Path) -> None:
        super().__init__(f"{file} is being loaded already")
        self.file = file


class ModuleLoader:
    """Loads each file once. Another loader loads it anew, as it is then; that of `anew`, as it was."""

    def __init__(self) -> None:
        self._modules: dict[Path, ModuleType] = {}
        self._siblings: dict[Path, dict[str, ModuleType]] = {}
        self._code: dict[Path, CodeType] = {}
        importlib.invalidate_caches()

    def anew(self) -> "ModuleLoader":
        """Return one for which nothing has run yet of the files that this one read; it does not read them."""
        other = ModuleLoader()
        other._code = self._code
        return other

    def load(self, file: Path) -> ModuleType:
        """The module of a file. Whatever its code raises passes through.

        Raises:
            BeingLoadedError: This is called by the code of the file itself, while it is loaded.
        """
        file = file.resolve()
        module = self._modules.get(file)
        if module is None:
            with _lock, _loaded_once(file), self.siblings_importable(file.parent, also_stdlib=True):
                module = self._modules[file] = self._execute(file)
        return module

    @contextmanager
    def siblings_importable(self, folder: Path, *, also_stdlib: bool = False) -> Iterator[None]:
        """Inside, the files of a folder can be imported, and are those of this loader.

        With `also_stdlib`, files with names of the standard library, too, as for a script of that folder.
        """
        siblings = self._siblings.setdefault(folder, {})
        shadowed = _shadowed_by(folder)
        # Lists, since to look at a module may import others, and so may other threads.
        hidden = {
            name: module
            for name, module in list(sys.modules.items())
            if name.partition(".")[0] in shadowed and not _is_of(name, module, folder)
        }
        before = set(sys.modules) - hidden.keys()
        for name in hidden:
            del sys.modules[name]
        sys.modules.update(
            {name: module for name, module in siblings.items() if also_stdlib or not _is_stdlib(name)}
        )
        if also_stdlib:
            sys.path.insert(0, str(folder))
        finder = _SiblingFinder(folder, self, also_stdlib)
        place = sys.meta_path.index(PathFinder) if PathFinder in sys.meta_path else len(sys.meta_path)
        sys.meta_path.insert(place, finder)
        try:
            yield
        finally:
            sys.meta_path.remove(finder)
            if also_stdlib and str(folder) in sys.path:
                sys.path.remove(str(folder))
            loaded = {
                name: module
                for name, module in list(sys.modules.items())
                if name not in before and _is_of(name, module, folder)
            }
            for name in loaded:
                del sys.modules[name]
            siblings.update(loaded)
            sys.modules.update(hidden)

    def _execute(self, file: Path) -> ModuleType:
        digest = hashlib.sha256(os.fsencode(file)).hexdigest()[:12]
        name = f"_gradysim_protocol_{digest}_{file.stem}"
        spec = _of_kept_code(importlib.util.spec_from_file_location(name, file), self)
        if spec is None or spec.loader is None:
            raise ImportError(f"{file.name} is no Python source file")
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        try:
            spec.loader.exec_module(module)
        except BaseException:
            del sys.modules[name]
            raise
        return module

    def code_of(self, file: Path, read: Callable[[], CodeType | None]) -> CodeType | None:
        """The code of a file as it was when it was read for the first time."""
        if file not in self._code:
            code = read()
            if code is None:
                return None
            self._code[file] = code
        return self._code[file]


class _KeptCode(SourceFileLoader):
    """Lets a file run as it was when its loader read it. A module keeps its loader by this."""

    def __init__(self, name: str, path: str, loader: ModuleLoader) -> None:
        super().__init__(name, path)
        self._loader = loader

    def get_code(self, fullname: str) -> CodeType | None:
        read = super().get_code
        return self._loader.code_of(Path(self.path).resolve(), lambda: read(fullname))


class _SiblingFinder(MetaPathFinder):
    """Finds the source files of a folder, as the path would."""

    def __init__(self, folder: Path, loader: ModuleLoader, also_stdlib: bool) -> None:
        self._folder = folder
        self._loader = loader
        self._also_stdlib = also_stdlib

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if _is_stdlib(fullname) and not self._also_stdlib:
            return None
        spec = PathFinder.find_spec(fullname, [str(self._folder)] if path is None else path, target)
        if spec is None or spec.origin is None or not Path(spec.origin).is_relative_to(self._folder):
            return None
        return _of_kept_code(spec, self._loader)


def _of_kept_code(spec: ModuleSpec | None, loader: ModuleLoader) -> ModuleSpec | None:
    if spec is not None and type(spec.loader) is SourceFileLoader:
        spec.loader = _KeptCode(spec.loader.name, spec.loader.path, loader)
    return spec


def _is_stdlib(name: str) -> bool:
    return name.partition(".")[0] in sys.stdlib_module_names


@contextmanager
def _loaded_once(file: Path) -> Iterator[None]:
    if file in _being_loaded:
        raise BeingLoadedError(file)
    _being_loaded.add(file)
    try:
        yield
    finally:
        _being_loaded.remove(file)


def _shadowed_by(folder: Path) -> set[str]:
    """The names of the modules in a folder that should be found in the place of others."""
    try:
        entries = list(os.scandir(folder))
    except OSError:  # the folder is gone, or was never there: nothing in it can be imported
        return set()
    files = {
        entry.name.removesuffix(".py") for entry in entries if entry.name.endswith(".py") and entry.is_file()
    }
    packages = {entry.name for entry in entries if os.path.isfile(os.path.join(entry.path, "__init__.py"))}
    return (files | packages) - sys.stdlib_module_names - {"__main__", "gradysim"}


def _is_of(name: str, module: ModuleType, folder: Path) -> bool:
    """Whether a module is a sibling file in the folder, or of a package that is one."""
    top_level, *_ = name.split(".")
    file = getattr(module, "__file__", None)
    if file is None:
        return any(Path(path).parent == folder for path in getattr(module, "__path__", ()) if "." not in name)
    path = Path(file).resolve()
    return path == folder / f"{top_level}.py" or path.is_relative_to(folder / top_level)
