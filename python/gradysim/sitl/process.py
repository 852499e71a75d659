"""The process of one autopilot: its folder, what it prints, its end."""

import os
import signal
import subprocess
import time
from collections.abc import Iterable, Sequence
from pathlib import Path

from gradysim.sitl.error import SitlError

GRACE_S = 2.0
"""Between SIGTERM, which an autopilot may be unable to follow, and SIGKILL."""

_LAST_LINES = 5


class AutopilotProcess:
    """A running program in a session of its own, which Ctrl-C at the terminal does not reach."""

    def __init__(self, name: str, command: Sequence[str], folder: Path, console: Path) -> None:
        """Start it.

        Args:
            name: The vehicle's, for people.
            command: The program, by its path, and its arguments; no shell sees them.
            folder: Its working directory.
            console: The file that takes what it prints.

        Raises:
            SitlError: It cannot be started.
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
        """Its process id, which is also that of its process group."""
        return self._process.pid

    @property
    def is_running(self) -> bool:
        """Whether it has not ended."""
        return self._process.poll() is None

    def obituary(self) -> str:
        """Say how it ended, and what it printed last."""
        try:
            status = self._process.wait(timeout=1.0)  # Its connection may break a moment before.
        except subprocess.TimeoutExpired:
            how = "the autopilot closed its connection, but still runs"
        else:
            signalled = -status if status < 0 else status - 128
            is_signal = signalled in set(signal.Signals)
            how = "the autopilot died of " + signal.Signals(signalled).name if is_signal else ""
            how = how or f"the autopilot ended with status {status}"
        printed = self.last_words()
        return f"{how}; it printed last: {printed}" if printed else f"{how}, and printed nothing"

    def last_words(self) -> str:
        """Return the last lines that it printed, in one."""
        return " | ".join(self._console.read_text(errors="replace").splitlines()[-_LAST_LINES:])

    def send(self, number: signal.Signals) -> None:
        """Send a signal to it and to what it started; no-op if all have ended."""
        try:
            os.killpg(self._process.pid, number)
        except (ProcessLookupError, PermissionError):
            return

    def wait_until(self, deadline_s: float) -> bool:
        """Wait for its end, at most until a time of `time.monotonic`; whether it came."""
        try:
            self._process.wait(timeout=max(0.0, deadline_s - time.monotonic()))
        except subprocess.TimeoutExpired:
            return False
        return True


def stop_all(processes: Iterable[AutopilotProcess], grace_s: float = GRACE_S) -> None:
    """End processes: SIGTERM to all, and SIGKILL to what is left of them after `grace_s` wall seconds."""
    running = [process for process in processes if process.is_running]
    for process in running:
        process.send(signal.SIGTERM)
    deadline_s = time.monotonic() + grace_s
    for process in running:
        process.wait_until(deadline_s)
        process.send(signal.SIGKILL)  # What a wrapper started may outlive it.
        process.wait_until(time.monotonic() + GRACE_S)
