"""The process of one autopilot: its user, its directory, its output and its end."""

import contextlib
import fcntl
import os
import pwd
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import BinaryIO

from gradysim.sitl import SitlError

GRACE_S = 2.0
"""Time between SIGTERM, which an autopilot may ignore, and SIGKILL."""

_LAST_LINES = 5


class AutopilotProcess:
    """A running program in its own session, so that Ctrl-C in the terminal does not reach it."""

    def __init__(self, name: str, command: Sequence[str], folder: Path, console: Path) -> None:
        """Start a program with arguments in the directory `folder`, with its output in the file `console`.

        `name` is that of the vehicle in messages. Raise SitlError if the program cannot be started.
        """
        self.name = name
        self._console = console
        try:
            with console.open("wb") as output:
                self._process = subprocess.Popen(
                    command,
                    cwd=folder,
                    stdin=subprocess.DEVNULL,
                    stdout=output,
                    stderr=subprocess.STDOUT,
                    start_new_session=True,
                )
        except OSError as error:
            raise SitlError(f"{name}: the autopilot cannot be started: {error}") from None

    @property
    def pid(self) -> int:
        """Id of the process and of its process group."""
        return self._process.pid

    @property
    def is_running(self) -> bool:
        """Whether the process runs."""
        return self._process.poll() is None

    def exit_report(self) -> str:
        """Return how the process ended, with its last output."""
        try:
            status = self._process.wait(timeout=1.0)  # Its connection may break shortly before.
        except subprocess.TimeoutExpired:
            how = "the autopilot closed its connection, but still runs"
        else:
            signalled = -status if status < 0 else status - 128
            is_signal = signalled in set(signal.Signals)
            how = "the autopilot died of " + signal.Signals(signalled).name if is_signal else ""
            how = how or f"the autopilot ended with status {status}"
        printed = self.last_output()
        return f"{how}; it printed last: {printed}" if printed else f"{how}, and printed nothing"

    def last_output(self) -> str:
        """Return the last lines of output, joined into one."""
        return " | ".join(self._console.read_text(errors="replace").splitlines()[-_LAST_LINES:])

    def send(self, number: signal.Signals) -> None:
        """Send a signal to the process group. Do nothing if all its processes have ended."""
        try:
            os.killpg(self._process.pid, number)
        except (ProcessLookupError, PermissionError):
            return

    def wait_until(self, deadline_s: float) -> bool:
        """Wait for the end, until `deadline_s` of `time.monotonic`. Return whether the process has ended."""
        try:
            self._process.wait(timeout=max(0.0, deadline_s - time.monotonic()))
        except subprocess.TimeoutExpired:
            return False
        return True


def stop_all(processes: Iterable[AutopilotProcess], grace_s: float = GRACE_S) -> None:
    """End processes: SIGTERM to all, then SIGKILL after `grace_s` seconds of wall time."""
    running = [process for process in processes if process.is_running]
    for process in running:
        process.send(signal.SIGTERM)
    deadline_s = time.monotonic() + grace_s
    for process in running:
        process.wait_until(deadline_s)
        process.send(signal.SIGKILL)  # A child of a wrapper may outlive it.
        process.wait_until(time.monotonic() + GRACE_S)


def user_for(wanted: str | None) -> str | None:
    """Return the user for a program: the wanted one if this process runs as root, otherwise None.

    Raise SitlError if the user or a required command does not exist.
    """
    if wanted is None or os.geteuid() != 0:
        return None
    try:
        pwd.getpwnam(wanted)
    except KeyError:
        raise SitlError(f"the user {wanted!r} for autopilots does not exist") from None
    for tool in ("setpriv", "timeout"):
        if shutil.which(tool) is None:
            raise SitlError(f"root needs the command {tool} to run autopilots as {wanted!r}")
    return wanted


def command_as(user: str | None, command: Sequence[str]) -> list[str]:
    """Return a command that runs `command` as a user (None: the same user) and kills it with its parent.

    An autopilot that rejects a parameter ignores even the end of its connection. So the kernel kills it, if
    there is `setpriv`.

    ArduPilot ends when it cannot signal its parent, which a process of another user cannot do if the parent
    belongs to root. So `setpriv` drops root's rights, and `timeout`, without a limit, is a parent of the same
    user that forwards signals.
    """
    mortal = ["setpriv", "--pdeathsig=KILL"]
    if user is None:
        return [*(mortal if shutil.which("setpriv") else []), *command]
    group = str(pwd.getpwnam(user).pw_gid)
    rights = [f"--reuid={user}", f"--regid={group}", "--clear-groups", "--no-new-privs"]
    return [*mortal, *rights, "timeout", "0", *mortal, *command]


_PREFIX = "gradysim-sitl-"
_LOCK = "owner.lock"


class FleetDirectory:
    """Temporary directory of a fleet. It is removed with the fleet, or after a SIGKILL by the next fleet.

    A lock on a file in the directory shows that its owner is alive: the kernel releases it however that
    process ends. Process ids are not enough, since they are reused and differ between containers.

    Attributes:
        path: The directory.
    """

    def __init__(self) -> None:
        """Remove the directories of dead owners and create a new one."""
        _remove_abandoned(Path(tempfile.gettempdir()))
        self.path = Path(tempfile.mkdtemp(prefix=_PREFIX))
        # Lock the file before it gets its name. So a file that can be locked has a dead owner.
        unnamed = self.path / f"{_LOCK}.new"
        self._lock: BinaryIO = unnamed.open("wb")
        fcntl.flock(self._lock, fcntl.LOCK_EX)
        unnamed.rename(self.path / _LOCK)

    def remove(self) -> None:
        """Remove the directory and its files. Do nothing if it was removed already."""
        shutil.rmtree(self.path, ignore_errors=True)
        self._lock.close()


def _remove_abandoned(parent: Path) -> None:
    """Remove the directories of this user whose owners are dead."""
    for folder in parent.glob(f"{_PREFIX}*"):
        with contextlib.suppress(OSError):  # of an owner that is alive, or without a file to lock
            if folder.lstat().st_uid == os.geteuid() and not folder.is_symlink():
                with (folder / _LOCK).open("rb") as lock:
                    fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    shutil.rmtree(folder, ignore_errors=True)
