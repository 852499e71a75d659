"""What lies beside the files of protocols can be imported while a run goes on: in functions, by pickle.

It is what the process imports from then on that changes, so that is done for one scenario at a time: another
one, in a thread or inside of a run, goes without.
"""

import sys
import threading
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.protocol.module import ModuleLoader
from gradysim.scenario.protocol.origin import loader_of, origin_of

_Folders = frozenset[tuple[ModuleLoader, Path]]

_lock = threading.RLock()
_importable: _Folders = frozenset()
_users = 0
_ends = ExitStack()


@contextmanager
def siblings_importable(classes: Iterable[type[IProtocol]]) -> Iterator[None]:
    """Inside, the files beside those of `classes` can be imported, as while these were loaded.

    A name that several of the folders have cannot: who asks for it is not known.
    """
    folders = frozenset(
        (loader, origin.file.parent)
        for cls in set(classes)
        if (origin := origin_of(cls)) and origin.file and (loader := loader_of(cls))
    )
    is_user = _begin(folders)
    try:
        yield
    finally:
        if is_user:
            _end()


def _begin(folders: _Folders) -> bool:
    global _importable, _users
    with _lock:
        if _users and folders != _importable:
            return False
        if not _users:
            for loader, folder in folders:
                _ends.enter_context(loader.siblings_importable(folder))
            _ends.enter_context(_blocked(_names_of_several(folder for _, folder in folders)))
            _importable = folders
        _users += 1
        return True


def _end() -> None:
    global _users
    with _lock:
        _users -= 1
        if not _users:
            _ends.close()


def _names_of_several(folders: Iterable[Path]) -> list[str]:
    each = list(folders)
    if len(each) < 2:
        return []
    files = Counter(file.stem for folder in each for file in folder.glob("*.py"))
    packages = Counter(file.parent.name for folder in each for file in folder.glob("*/__init__.py"))
    return [name for name, count in (files + packages).items() if count > 1]


@contextmanager
def _blocked(names: Iterable[str]) -> Iterator[None]:
    before = {name: sys.modules.pop(name) for name in names if name in sys.modules}
    sys.modules.update(dict.fromkeys(names))  # type: ignore[arg-type]  # None: there is no such module
    try:
        yield
    finally:
        for name in names:
            sys.modules.pop(name, None)
        sys.modules.update(before)
