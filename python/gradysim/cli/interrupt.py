"""Ctrl-C as a request to stop: the first press sets a flag, the second one raises KeyboardInterrupt.

A run stops between two of its slices and keeps its results. A second press leaves a callback that never
returns. While worker processes carry out the runs, a third press kills them.
"""

import contextlib
import os
import signal
import threading
from collections.abc import Collection, Iterator
from types import FrameType
from typing import Self

FORWARDED = signal.SIGUSR1 if hasattr(signal, "SIGUSR1") else signal.SIGINT
"""What the command sends its workers when Ctrl-C is pressed.

It differs from SIGINT, which a terminal sends to the command and to its workers: a worker that gets both
must count one press.
"""

_ERROR_OUTPUT = 2  # the file descriptor


class StopOnInterrupt:
    """While inside the `with` block, SIGINT sets the flag that `should_stop()` reads, and says so.

    Outside the main thread, where Python allows no signal handlers, the flag is never set.

    Attributes:
        workers: Ids of the processes that each press is passed on to.
    """

    def __init__(self) -> None:
        self.workers: Collection[int] = ()
        self._presses = {signal.SIGINT: 0, FORWARDED: 0}
        self._in_worker = False
        self._at_once = False

    def should_stop(self) -> bool:
        """Return whether Ctrl-C was pressed."""
        return max(self._presses.values()) > 0

    def become_worker(self) -> None:
        """Handle the presses as a process that was forked from the command, which has the other end."""
        self.workers = ()
        self._in_worker = True
        signal.signal(signal.SIGINT, self._on_signal)
        signal.signal(FORWARDED, self._on_signal)

    @contextlib.contextmanager
    def at_once(self) -> Iterator[None]:
        """While inside, the first press raises, too: what is only being built has no results to keep."""
        if self.should_stop():
            raise KeyboardInterrupt
        self._at_once = True
        try:
            yield
        finally:
            self._at_once = False

    def __enter__(self) -> Self:
        self._in_main_thread = threading.current_thread() is threading.main_thread()
        if self._in_main_thread:
            self._previous = signal.signal(signal.SIGINT, self._on_signal)
        return self

    def __exit__(self, *_: object) -> None:
        if self._in_main_thread:
            signal.signal(signal.SIGINT, self._previous)

    def _on_signal(self, number: int, _frame: FrameType | None) -> None:
        before = max(self._presses.values())
        self._presses[signal.Signals(number)] += 1
        presses = max(self._presses.values())
        if presses == before:  # the terminal or the command has told of this press already
            return
        for worker in self.workers:
            with contextlib.suppress(ProcessLookupError):
                os.kill(worker, FORWARDED)
        if self._at_once or presses > (2 if self.workers else 1):
            if not self._in_worker:
                signal.signal(signal.SIGINT, signal.SIG_IGN)  # or one more would interrupt the end
            raise KeyboardInterrupt
        if presses == 1 and not self._in_worker:
            with contextlib.suppress(OSError):  # not by sys.stderr, which may be in the middle of a line
                os.write(_ERROR_OUTPUT, b"\nstopping after this step; Ctrl-C once more stops at once\n")
