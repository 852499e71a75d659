"""Ctrl-C, SIGTERM and SIGHUP during runs, and the time of --stop-after.

Each is a press. The first one sets a flag: a run stops between two of its slices and keeps its results. The
second one raises KeyboardInterrupt in the process of the run, to leave a callback that never returns. The
third one raises it in the command, which kills its worker processes. Only Ctrl-C has to be pressed again. The
other signals and the end of the time come once, so their next presses come by themselves.
"""

import contextlib
import os
import signal
import threading
from collections import Counter
from collections.abc import Callable, Collection, Iterator
from math import inf
from types import FrameType
from typing import Any, Self

from gradysim.cli.errors import INCOMPLETE, INTERRUPTED, OK

FORWARDED = signal.SIGUSR1 if hasattr(signal, "SIGUSR1") else signal.SIGINT
"""What the command sends its workers at each press.

It differs from SIGINT, which a terminal sends to the command and to its workers: a worker that gets both
must count one press.
"""

STOPPING = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))
"""Signals that ask a command to stop."""

WATCHED = (*STOPPING, FORWARDED)

KILLING = 3
"""Number of presses after which no worker process goes on."""

_ONCE = [number for number in STOPPING if number != signal.SIGINT]
"""The kernel, the shell and others may send the same signal. The next presses come automatically."""

_GRACE_S = {1: 0.3, 2: 20.0}
"""{presses: wall time in seconds until the next one comes automatically, if it was not Ctrl-C}.

A callback that returns does so in the first period. The second one is for a worker that writes large files.
"""

_ALARM = getattr(signal, "SIGALRM", None)
"""Signal of the timer."""

_REPLIES: dict[int | None, bytes] = {
    signal.SIGINT: b"\nstopping after this step; Ctrl-C once more stops at once\n",
    _ALARM: b"\n--stop-after: stopping after this step\n",
}
_REPLY = b"\nstopping after this step\n"

_OUTPUT, _ERROR_OUTPUT = 1, 2  # file descriptors


class StopOnInterrupt:
    """While inside the `with` block, SIGINT, SIGTERM and SIGHUP set the flag that `should_stop()` reads.

    A press is any of these signals, once or from several senders. SIGTERM and SIGHUP count as the first press
    only. A signal that is ignored on entry stays ignored, as with `nohup`. Outside the main thread, where
    Python allows no signal handlers, the flag is never set.

    Attributes:
        workers: Ids of the processes that each press is forwarded to.
        exit_code: Exit code of a stopped command: 130 after Ctrl-C, 143 after SIGTERM, 129 after SIGHUP, 5
            after the time of --stop-after.
    """

    def __init__(
        self, stop_after_s: float | None = None, *, raises_at: int = 2, grace_s: float | None = None
    ) -> None:
        """Prepare.

        Args:
            stop_after_s: Wall time in seconds from entry to a press; None for no such press.
            raises_at: Number of presses that raises KeyboardInterrupt.
            grace_s: For a command that has no results to write: wall time in seconds from the first press of
                any kind to KeyboardInterrupt, and from there to the end of the process. None for no limit.
        """
        self._stop_after_s = stop_after_s
        self._raises_at: float = raises_at
        self._grace_s = grace_s
        self.workers: Collection[int] = ()
        self.exit_code = INTERRUPTED
        self._presses: Counter[int] = Counter()
        self._pid = os.getpid()
        self._in_worker = False
        self._previous: dict[signal.Signals, Any] = {}
        self._terminals: list[int] = []

    @property
    def presses(self) -> int:
        """Number of presses."""
        return max(self._presses.values(), default=0)

    def should_stop(self) -> bool:
        """Return whether there was a press. A process that a callback forked ends here."""
        self._end_if_forked()
        return self.presses > 0

    def become_worker(self) -> None:
        """Handle presses in a process forked from the command, which has the other end.

        They raise in blocks of `at_once` and `executing` only, since a worker has results to write.
        """
        self.workers = ()
        self._raises_at = inf
        self._in_worker = True
        self._pid = os.getpid()
        self._terminals = _terminals()
        signal.signal(signal.SIGINT, self._on_signal)
        signal.signal(FORWARDED, self._on_signal)

    @contextlib.contextmanager
    def at_once(self) -> Iterator[None]:
        """Raise at the first press inside the block: a run that is being built has no results to keep."""
        if self.should_stop():
            raise KeyboardInterrupt
        with self._raising_at(1):
            yield

    @contextlib.contextmanager
    def executing(self) -> Iterator[None]:
        """Raise at the second press inside the block."""
        try:
            with self._raising_at(2):
                yield
        finally:
            self._end_if_forked()

    @contextlib.contextmanager
    def _raising_at(self, presses: int) -> Iterator[None]:
        before, self._raises_at = self._raises_at, presses
        try:
            yield
        finally:
            self._raises_at = before

    def __enter__(self) -> Self:
        if threading.current_thread() is threading.main_thread():
            self._terminals = _terminals()
            for number in STOPPING:
                if number == signal.SIGINT or signal.getsignal(number) != signal.SIG_IGN:
                    self._previous[number] = signal.signal(number, self._on_signal)
            if self._stop_after_s is not None:
                self._alarm_after(max(self._stop_after_s, 0.0), self._on_alarm)
                if self._stop_after_s <= 0:
                    signal.raise_signal(signal.SIGALRM)
        return self

    def __exit__(self, *_: object) -> None:
        if _ALARM in self._previous:
            signal.setitimer(signal.ITIMER_REAL, 0)
        for number, handler in self._previous.items():
            signal.signal(number, handler)

    def _end_if_forked(self) -> None:
        """Exit if this is a process that a protocol's callback forked. Its parent executes the run."""
        if os.getpid() != self._pid:
            os._exit(OK)

    def _on_signal(self, number: int, _frame: FrameType | None) -> None:
        before = self.presses
        self._presses[number] = 1 if number in _ONCE else self._presses[number] + 1
        self._leave_dead_terminals()
        if self.presses > before:  # otherwise another sender has reported this press
            self._press(number, self.presses)

    def _press(self, number: int, presses: int) -> None:
        if presses == 1:
            self.exit_code = INCOMPLETE if number == _ALARM else 128 + number
        raises = presses >= self._raises_at
        if raises and not self._in_worker:
            for each in self._previous:
                signal.signal(each, signal.SIG_IGN)  # another one would interrupt the exit
            if self._grace_s is not None:
                self._alarm_after(self._grace_s, self._end_now)
        for worker in self.workers:
            with contextlib.suppress(ProcessLookupError):
                os.kill(worker, FORWARDED)
        if raises:
            raise KeyboardInterrupt
        if self._in_worker:
            return
        if self._grace_s is not None:
            self._alarm_after(self._grace_s, self._on_alarm)
            return
        if number != signal.SIGINT:
            self._alarm_after(_GRACE_S.get(presses, 0.0), self._on_alarm)
        if presses == 1:
            with contextlib.suppress(OSError):  # sys.stderr may be in the middle of a line
                os.write(_ERROR_OUTPUT, _REPLIES.get(number, _REPLY))

    def _alarm_after(self, duration_s: float, handler: Callable[[int, FrameType | None], None]) -> None:
        """Call a handler of SIGALRM after a wall time in seconds; 0 for never."""
        before = signal.signal(signal.SIGALRM, handler)
        self._previous.setdefault(signal.SIGALRM, before)
        signal.setitimer(signal.ITIMER_REAL, duration_s)

    def _end_now(self, _number: int, _frame: FrameType | None) -> None:
        os._exit(self.exit_code)

    def _on_alarm(self, number: int, frame: FrameType | None) -> None:
        self._presses[number] = self.presses
        self._on_signal(number, frame)

    def _leave_dead_terminals(self) -> None:
        """Discard output to a closed terminal. An error would end the command."""
        for descriptor in self._terminals:
            if not os.isatty(descriptor):
                os.dup2(os.open(os.devnull, os.O_RDWR), descriptor)


def _terminals() -> list[int]:
    return [descriptor for descriptor in (_OUTPUT, _ERROR_OUTPUT) if os.isatty(descriptor)]
