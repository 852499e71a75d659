"""Files that are replaced as a whole, also if the process is killed or the power fails.

A new file has the id of its process at the end of its name until it is complete and on the disk.
"""

import contextlib
import errno
import os
import re
from collections.abc import Callable, Iterator
from pathlib import Path

from gradysim.scenario.errors import BadValue
from gradysim.scenario.parse.regular_files import check_regular

LONGEST_PID = 2**22
"""On Linux."""

_UNFINISHED = re.compile(r"(?P<name>.+\.(json|sca|vec|pcap|html))\.\d{1,7}")
_CANNOT_SYNC = (errno.EINVAL, errno.ENOTSUP, errno.EACCES)
"""Errors of file systems that cannot sync a directory, and of a directory that may not be read."""


def unfinished_file(path: Path, pid: int | None = None) -> Path:
    """Return the name of a file until it is complete. `pid` is the process that writes it; None: this one."""
    return path.with_name(f"{path.name}.{os.getpid() if pid is None else pid}")


def finished_name(name: str) -> str | None:
    """Return the final name of an unfinished file; None for any other file."""
    found = _UNFINISHED.fullmatch(name)
    return found["name"] if found else None


@contextlib.contextmanager
def naming(path: Path) -> Iterator[None]:
    """Add the name of a file to an OSError that has none, such as that of a failed read."""
    try:
        yield
    except OSError as error:
        if error.filename is None:
            error.filename = str(path)
        raise


def bytes_in(path: Path) -> bytes:
    """Return the content of a file. Raises OSError with its name, also if a read fails."""
    with naming(path):
        return path.read_bytes()


def check_replaceable(path: Path) -> None:
    """Raise OSError if something is at `path` that is not a regular file, such as a pipe or a directory."""
    try:
        check_regular(path, "it")
    except BadValue as error:
        code = errno.EISDIR if path.is_dir() else errno.EEXIST
        raise OSError(code, f"{error.problem}; expected {error.expected}", str(path)) from None


@contextlib.contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield the name for a new file, which then replaces `path` as a whole or not at all.

    Missing directories are created. Raises OSError, with the name of the file, if it cannot be written.
    """
    check_replaceable(path)
    make_directory(path.parent)
    unfinished = unfinished_file(path)
    try:
        unfinished.unlink(missing_ok=True)  # left by a killed process with the same id
        yield unfinished
        finish(path)
    except BaseException as error:
        with contextlib.suppress(OSError):  # a read-only directory
            unfinished.unlink(missing_ok=True)
        if isinstance(error, OSError):  # for a full disk it has no file name
            raise OSError(error.errno, error.strerror, str(path)) from error
        raise


@contextlib.contextmanager
def replacing_all() -> Iterator[Callable[[Path], Path]]:
    """Yield a function that returns the name for a new file, which replaces its argument at the end.

    One sync is for all of them, since a sync of each file takes milliseconds. Raises OSError as `replacing`.
    """
    paths: list[Path] = []

    def begin(path: Path) -> Path:
        check_replaceable(path)
        paths.append(path)
        return unfinished_file(path)

    try:
        yield begin
        if hasattr(os, "sync"):
            os.sync()
        for path in paths:
            unfinished_file(path).replace(path)
        for directory in {path.parent for path in paths}:
            _sync_directory(directory)
    except BaseException as error:
        for path in paths:
            with contextlib.suppress(OSError):
                unfinished_file(path).unlink()
        names = (None, *(str(unfinished_file(path)) for path in paths[-1:]))
        if isinstance(error, OSError) and paths and error.filename in names:
            raise OSError(error.errno, error.strerror, str(paths[-1])) from error
        raise


def make_directory(directory: Path) -> None:
    """Create a directory and its parents, if missing. They survive a power failure. Raises OSError."""
    missing = [each for each in (directory, *directory.parents) if not each.exists()]
    directory.mkdir(parents=True, exist_ok=True)
    for each in missing:
        _sync_directory(each.parent)


def finish(path: Path) -> None:
    """Rename the complete `unfinished_file(path)`. Both survive a power failure.

    Raises OSError, with the name of a file, also if the unfinished file is missing.
    """
    unfinished = unfinished_file(path)
    _sync(unfinished, os.O_RDWR)
    unfinished.replace(path)
    _sync_directory(path.parent)


def _sync_directory(directory: Path) -> None:
    if hasattr(os, "O_DIRECTORY"):  # other systems cannot open a directory
        try:
            _sync(directory, os.O_RDONLY)
        except OSError as error:
            if error.errno not in _CANNOT_SYNC:
                raise


def _sync(path: Path, flags: int) -> None:
    descriptor = os.open(path, flags)
    try:
        with naming(path):
            os.fsync(descriptor)
    finally:
        os.close(descriptor)
