"""Files that are replaced as a whole, also if the process is killed or the power fails.

A new file has the id of its process at the end of its name until it is complete and on the disk.
"""

import contextlib
import errno
import os
import re
from collections.abc import Iterator
from pathlib import Path

from gradysim.scenario.errors import BadValue
from gradysim.scenario.regular_files import check_regular

LONGEST_PID = 2**22
"""On Linux."""

_UNFINISHED = re.compile(r"(?P<name>.+\.(json|sca|vec|pcap|html))\.\d{1,7}")
_CANNOT_SYNC = (errno.EINVAL, errno.ENOTSUP)
"""Errors of file systems that cannot sync a directory."""


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
def replacing(path: Path, *, synced: bool = True) -> Iterator[Path]:
    """Yield the name for a new file, which then replaces `path` as a whole or not at all.

    Missing directories are created. Unless `synced`, the caller syncs the file system after several files.
    Raises OSError, with the name of the file, if it cannot be written.
    """
    check_replaceable(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = unfinished_file(path)
    try:
        unfinished.unlink(missing_ok=True)  # left by a killed process with the same id
        yield unfinished
        if synced:
            finish(path)
        else:
            unfinished.replace(path)
    except BaseException as error:
        with contextlib.suppress(OSError):  # a read-only directory
            unfinished.unlink(missing_ok=True)
        if isinstance(error, OSError):  # for a full disk it has no file name
            raise OSError(error.errno, error.strerror, str(path)) from error
        raise


def finish(path: Path) -> None:
    """Rename the complete `unfinished_file(path)`. Both survive a power failure.

    Raises OSError, with the name of a file, also if the unfinished file is missing.
    """
    unfinished = unfinished_file(path)
    _sync(unfinished, os.O_RDWR)
    unfinished.replace(path)
    if hasattr(os, "O_DIRECTORY"):  # other systems cannot open a directory
        try:
            _sync(path.parent, os.O_RDONLY)
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
