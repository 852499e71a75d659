"""Locks of runs: one process at a time computes a run in a directory, and removes files of killed ones.

A lock is a POSIX record lock on one byte of a file in the directory. It also holds between machines that
share the directory by NFS. The kernel releases it when the process ends, however that happens. Forked
processes do not inherit it. Windows has no such locks.

On a file system without locks, a lease takes their place: a file with host and process that the process
touches every `HEARTBEAT_S` while it computes the run. A lease has expired after `LEASE_S` without a touch.
"""

import contextlib
import errno
import hashlib
import json
import os
import socket
import struct
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

from gradysim.results.durable import finished_name, make_directory
from gradysim.results.pack import PACKS

LOCK_FILE = ".gradysim.lock"

LEASE_S = 120.0
"""Wall time after which the lease of a process that has died has expired, in seconds."""

HEARTBEAT_S = 10.0
"""Wall time between two touches of a lease, in seconds."""

_ALL = (0, 0)
"""From the first byte to the last."""

_IS_LOCKED = (errno.EACCES, errno.EAGAIN)
_NO_LOCKS = (errno.ENOLCK, errno.ENOSYS, errno.ENOTSUP, errno.EOPNOTSUPP, errno.EINVAL)
_STRUCT_FLOCK = "hhqqi4x"
"""On Linux: type, whence, start, length, id of the process."""

_LEASE = ".gradysim.lease."
_LEASE_OF_ALL = f"{_LEASE}all"


class RunLockedError(Exception):
    """Another process computes the run.

    Attributes:
        pid: Its id, if the system knows it. It may be an id on another machine.
        host: Its machine, if a lease says so.
    """

    def __init__(self, pid: int | None, host: str | None = None) -> None:
        which = "another process" if pid is None else f"process {pid}"
        super().__init__(f"{which}{f' on {host}' if host else ''} is computing it")
        self.pid = pid
        self.host = host


class _NoLocksError(OSError):
    """The file system has no locks."""


@contextlib.contextmanager
def run_locked(directory: Path, name: str) -> Iterator[None]:
    """Hold the lock of the run of that name. The directory is created if missing.

    A process that opens the lock file once more and closes it loses its locks, so it computes one run at a
    time. Raises RunLockedError if another process holds the lock, and OSError.
    """
    make_directory(directory)
    digest = hashlib.sha256(name.encode(errors="surrogatepass"))
    # 56 bits, so that two names have different values in practice.
    byte = int.from_bytes(digest.digest()[:7])
    with contextlib.ExitStack() as held:
        try:
            held.enter_context(_locked(directory / LOCK_FILE, (byte, 1)))
        except _NoLocksError:
            held.enter_context(_leased(directory / f"{_LEASE}{digest.hexdigest()[:14]}"))
            _check_expired(directory / _LEASE_OF_ALL)
        yield


@contextlib.contextmanager
def all_runs_locked(directory: Path) -> Iterator[None]:
    """Hold the locks of all runs in a directory.

    Runs that other processes begin meanwhile wait; on a file system without locks they are left out. Raises
    RunLockedError if another process computes a run in the directory, and OSError.
    """
    with contextlib.ExitStack() as held:
        try:
            held.enter_context(_all_locked(directory))
        except _NoLocksError:
            mine = directory / _LEASE_OF_ALL
            held.enter_context(_leased(mine))
            for lease in directory.glob(f"{_LEASE}*"):
                if lease != mine:
                    _check_expired(lease)
        yield


def remove_left_over_files(directory: Path) -> bool:
    """Remove unfinished files and packs, and the lock file, unless a run is computed in the directory.

    Return False if the file system has no locks. Then nothing is removed.
    """
    try:
        with _all_locked(directory):
            for file in [*_unfinished_files(directory), *_unfinished_files(directory / PACKS)]:
                file.unlink(missing_ok=True)
    except _NoLocksError:
        return False
    except (RunLockedError, OSError):  # the directory is missing or not writable
        pass
    return True


def remove_lock_file(directory: Path) -> None:
    """Remove the lock file, unless a run is computed in the directory."""
    with contextlib.suppress(RunLockedError, OSError), _all_locked(directory):
        pass


def _unfinished_files(directory: Path) -> list[Path]:
    if not directory.is_dir():
        return []
    return [Path(entry) for entry in os.scandir(directory) if finished_name(entry.name) is not None]


@contextlib.contextmanager
def _all_locked(directory: Path) -> Iterator[None]:
    """Hold the locks of all runs, and remove the lock file. Raises RunLockedError and OSError."""
    file = directory / LOCK_FILE
    with _locked(file, _ALL):
        try:
            yield
        finally:
            file.unlink(missing_ok=True)


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
                if error.errno not in _IS_LOCKED:
                    kind = _NoLocksError if error.errno in _NO_LOCKS else OSError
                    raise kind(error.errno, error.strerror, str(path)) from None
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


@contextlib.contextmanager
def _leased(lease: Path) -> Iterator[None]:
    """Hold a lease, and touch it. Raises RunLockedError if another process holds it, and OSError."""
    descriptor = _new_lease(lease)
    has_ended = threading.Event()

    def touch() -> None:
        while not has_ended.wait(HEARTBEAT_S):
            with contextlib.suppress(OSError):
                os.utime(descriptor)  # not by name: if it has expired, another process may have one there

    heart = threading.Thread(target=touch, name="gradysim lease", daemon=True)
    try:
        os.write(descriptor, json.dumps({"host": socket.gethostname(), "pid": os.getpid()}).encode())
        heart.start()
        yield
    finally:
        has_ended.set()
        if heart.is_alive():
            heart.join()
        if _is_at(lease, descriptor):
            lease.unlink(missing_ok=True)
        os.close(descriptor)


def _new_lease(lease: Path) -> int:
    """Create a lease, and return its descriptor. One that has expired is removed."""
    while True:
        try:
            return os.open(lease, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
        except FileExistsError:
            _check_expired(lease)
        expired = lease.with_name(f"{lease.name}.{socket.gethostname()}.{os.getpid()}")
        with contextlib.suppress(FileNotFoundError):
            lease.replace(expired)  # one process does this, and the others find nothing or a new lease
            try:
                _check_expired(expired)
            except RunLockedError:
                with contextlib.suppress(FileExistsError):
                    os.link(expired, lease)
                raise
            finally:
                expired.unlink()


def _check_expired(lease: Path) -> None:
    """Raise RunLockedError if a lease exists and has not expired."""
    try:
        with lease.open("rb") as file:  # by NFS, a file that was just opened has its current time
            age_s = _now_s(lease.parent) - os.fstat(file.fileno()).st_mtime
            content = file.read()
    except FileNotFoundError:
        return
    if age_s <= LEASE_S:
        try:
            holder = json.loads(content)
        except ValueError:  # it is being written
            holder = {}
        raise RunLockedError(holder.get("pid"), holder.get("host"))


def _now_s(directory: Path) -> float:
    """Return the time by the clock of the file system, since the clocks of machines differ."""
    clock = directory / LOCK_FILE
    clock.touch()
    return clock.stat().st_mtime
