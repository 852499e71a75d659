"""Where the class of a protocol comes from, so that a scenario can go to another process, or begin anew.

pickle names a class by its module, which another process does not find: the module of a file has a name that
only this one knows (see module). The file is what leads to the class there. Native protocols are made from
the engine's table in each process.
"""

import threading
from dataclasses import dataclass
from pathlib import Path
from weakref import ReferenceType, WeakKeyDictionary, ref

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.protocol.module import ModuleLoader


@dataclass(frozen=True)
class Origin:
    """Where a class was loaded from.

    Attributes:
        file: The file, with its whole path; None for a native protocol.
        name: Name of the class in it, or of the native protocol.
        load: What names the loader of the class: a file may have been loaded again, and be another one then.
    """

    file: Path | None
    name: str
    load: str = ""


_lock = threading.Lock()
_origins: WeakKeyDictionary[type[IProtocol], Origin] = WeakKeyDictionary()
"""Of the classes of files; modules belong to the whole process, as in sys.modules."""
_loaders: WeakKeyDictionary[type[IProtocol], ReferenceType[ModuleLoader]] = WeakKeyDictionary()
"""Of the same classes: weak, as a loader has its modules, and these have their classes."""


def remember_origin(cls: type[IProtocol], origin: Origin, loader: ModuleLoader) -> None:
    """Note where a class was loaded from; the first place counts."""
    with _lock:
        _origins.setdefault(cls, origin)
        _loaders.setdefault(cls, ref(loader))


def origin_of(cls: type[IProtocol]) -> Origin | None:
    """Return where a class was loaded from; None for one that was imported by the name of its module."""
    with _lock:
        return _origins.get(cls)


def loader_of(cls: type[IProtocol]) -> ModuleLoader | None:
    """Return what loaded the file of a class; None if that is not there any more, or was no file."""
    with _lock:
        loader = _loaders.get(cls)
    return loader() if loader is not None else None


def class_loaded_from(origin: Origin) -> type[IProtocol] | None:
    """Return the class that was loaded from there in this process; None in another one."""
    with _lock:
        return next((cls for cls, known in _origins.items() if known == origin), None)
