"""Loads the Python file of a protocol, as a module that collides with no other.

The module's name is made of its whole path, so that files of one name are different modules. While it loads,
its folder is importable, for sibling files. These siblings are shared by the protocols of that folder only:
afterwards they are taken out of `sys.modules`, where a sibling of the same name in another folder would find
them.
"""

import hashlib
import importlib
import importlib.util
import os
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType

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
    """Loads each file once. Another loader loads it anew, as it is then."""

    def __init__(self) -> None:
        self._modules: dict[Path, ModuleType] = {}
        self._siblings: dict[Path, dict[str, ModuleType]] = {}
        importlib.invalidate_caches()

    def load(self, file: Path) -> ModuleType:
        """The module of a file. Whatever its code raises passes through.

        Raises:
            BeingLoadedError: This is called by the code of the file itself, while it is loaded.
        """
        file = file.resolve()
        module = self._modules.get(file)
        if module is None:
            with _lock, _loaded_once(file), self._siblings_importable(file.parent):
                module = self._modules[file] = _execute(file)
        return module

    @contextmanager
    def _siblings_importable(self, folder: Path) -> Iterator[None]:
        siblings = self._siblings.setdefault(folder, {})
        # Lists, since to look at a module may import others, and so may other threads.
        hidden = {
            name: module
            for name, module in list(sys.modules.items())
            if _is_shadowed(name.partition(".")[0], folder) and not _is_of(name, module, folder)
        }
        before = set(sys.modules) - hidden.keys()
        for name in hidden:
            del sys.modules[name]
        sys.modules.update(siblings)
        sys.path.insert(0, str(folder))
        try:
            yield
        finally:
            if str(folder) in sys.path:
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


@contextmanager
def _loaded_once(file: Path) -> Iterator[None]:
    if file in _being_loaded:
        raise BeingLoadedError(file)
    _being_loaded.add(file)
    try:
        yield
    finally:
        _being_loaded.remove(file)


def _execute(file: Path) -> ModuleType:
    digest = hashlib.sha256(os.fsencode(file)).hexdigest()[:12]
    name = f"_gradysim_protocol_{digest}_{file.stem}"
    spec = importlib.util.spec_from_file_location(name, file)
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


def _is_shadowed(top_level: str, folder: Path) -> bool:
    """Whether the folder has a module of that name which should be found in its place."""
    if top_level in sys.stdlib_module_names or top_level in ("__main__", "gradysim"):
        return False
    return (folder / f"{top_level}.py").is_file() or (folder / top_level / "__init__.py").is_file()


def _is_of(name: str, module: ModuleType, folder: Path) -> bool:
    """Whether a module is a sibling file in the folder, or of a package that is one."""
    top_level, *_ = name.split(".")
    file = getattr(module, "__file__", None)
    if file is None:
        return any(Path(path).parent == folder for path in getattr(module, "__path__", ()) if "." not in name)
    path = Path(file).resolve()
    return path == folder / f"{top_level}.py" or path.is_relative_to(folder / top_level)
