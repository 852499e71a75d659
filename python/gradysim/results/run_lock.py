"""Locks of runs: one process at a time computes a run in a directory, and removes files of killed ones.

A lock is a POSIX record lock on one byte of a file in the directory. It also holds between machines that
share the directory by NFS. The kernel releases it when the process ends, however that happens. Forked
processes do not inherit it. Windows has no such locks.
"""

import contextlib
import errno
import hashlib
import os
import struct
import sys
import time
from collections.abc import Iterator
from pathlib import Path

from gradysim.results.durable import finished_name
from gradysim.results.pack import PACKS

LOCK_FILE = ".gradysim.lock"

_ALL = (0, 0)
"""From the first byte to the last."""

_IS_LOCKED = (errno.EACCES, errno.EAGAIN)
_STRUCT_FLOCK = "hhqqi4x"
"""On Linux: type, whence, start, length, id of the process."""


class RunLockedError(Exception):
    """Another process computes the run.

    Attributes:
        pid: Its id, if the system knows it. It may be an id on another machine.
    """

    def __init__(self, pid: int | None) -> None:
        which = "another process" if pid is None else f"process {pid}"
        super().__init__(f"{which} is computing it")
        self.pid = pid


@contextlib.contextmanager
def run_locked(directory: Path, name: str) -> Iterator[None]:
    """Hold the lock of the run of that name. The directory is created if missing.

    A process that opens the lock file once more and closes it loses its locks, so it computes one run at a
    time. Raises RunLockedError if another process holds the lock.
    """
    directory.mkdir(parents=True, exist_ok=True)
    # 56 bits, so that two names have different values in practice.
    byte = int.from_bytes(hashlib.sha256(name.encode(errors="surrogatepass")).digest()[:7])
    with _locked(directory / LOCK_FILE, (byte, 1)):
        yield


@contextlib.contextmanager
def all_runs_locked(directory: Path) -> Iterator[None]:
    """Hold the locks of all runs in a directory. Runs that other processes begin meanwhile wait.

    Raises RunLockedError if another process computes a run in the directory.
    """
    file = directory / LOCK_FILE
    with _locked(file, _ALL):
        try:
            yield
        finally:
            file.unlink(missing_ok=True)


def remove_left_over_files(directory: Path) -> None:
    """Remove unfinished files and packs, and the lock file, unless a run is computed in the directory."""
    try:
        left_over = [*_unfinished_files(directory), *_unfinished_files(directory / PACKS)]
        if left_over or (directory / LOCK_FILE).exists():
            with all_runs_locked(directory):
                for file in left_over:
                    file.unlink(missing_ok=True)
    except (RunLockedError, OSError):  # the directory is missing or not writable
        return


def _unfinished_files(directory: Path) -> list[Path]:
    if not directory.is_dir():
        return []
    return [Path(entry) for entry in os.scandir(directory) if finished_name(entry.name) is not None]


@contextlib.contextmanager
def _locked(path: Path, section: tuple[int, int]) -> Iterator[None]:
    """Hold the lock of a section (first byte, length) of a file."""
    descriptor = _open_locked(path, section)
    try:
        yield
    finally:
        if descriptor is not None:
            os.close(descriptor)


def _open_locked(path: Path, section: tuple[int, int]) -> int | None:
    if sys.platform == "win32":
        return None
    import fcntl

    start, length = section
    while True:
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
        try:
            fcntl.lockf(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB, length, start)
        except OSError as error:
            try:
                if error.errno not in _IS_LOCKED:  # a file system without locks
                    return None
                is_for_long, pid = _holder(descriptor, section)
            finally:
                os.close(descriptor)
            if is_for_long or section == _ALL:
                raise RunLockedError(pid) from None
            time.sleep(0.001)
            continue
        if _is_at(path, descriptor):
            return descriptor
        os.close(descriptor)  # it was removed in the meantime


def _holder(descriptor: int, section: tuple[int, int]) -> tuple[bool, int | None]:
    """Return whether the lock is held for a run, and the process that holds it, if known."""
    if sys.platform != "linux":
        return True, None
    import fcntl

    start, length = section
    wanted = struct.pack(_STRUCT_FLOCK, fcntl.F_WRLCK, os.SEEK_SET, start, length, 0)
    kind, _, _, found_length, pid = struct.unpack(
        _STRUCT_FLOCK, fcntl.fcntl(descriptor, fcntl.F_GETLK, wanted)
    )
    return kind != fcntl.F_UNLCK and found_length != 0, pid


def _is_at(path: Path, descriptor: int) -> bool:
    try:
        return os.path.samestat(os.stat(path), os.fstat(descriptor))
    except FileNotFoundError:
        return False
