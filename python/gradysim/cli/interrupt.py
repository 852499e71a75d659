"""Ctrl-C as a wish to stop: the first press sets a flag, the second one raises KeyboardInterrupt.

So a run stops between two of its slices, with its results whole; a protocol that never returns from a
callback can still be left.
"""

import contextlib
import os
import signal
import threading
from collections.abc import Iterator
from types import FrameType
from typing import Self

_ERROR_OUTPUT = 2  # the file descriptor


class StopOnInterrupt:
    """While inside the `with` block, SIGINT sets the flag that `should_stop()` reads, and says so.

    Outside the main thread, where Python allows no signal handlers, the flag is never set. One that is
    `silent` says nothing.
    """

    def __init__(self, *, silent: bool = False) -> None:
        self._silent = silent
        self._pressed = False
        self._at_once = False

    def should_stop(self) -> bool:
        """Return whether Ctrl-C was pressed."""
        return self._pressed

    @contextlib.contextmanager
    def at_once(self) -> Iterator[None]:
        """While inside, the first press raises, too: what is only being built has no results to keep."""
        if self._pressed:
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

    def _on_signal(self, _signal: int, _frame: FrameType | None) -> None:
        if self._pressed or self._at_once:
            raise KeyboardInterrupt
        self._pressed = True
        if self._silent:
            return
        with contextlib.suppress(OSError):  # not by sys.stderr, which may be in the middle of a line
            os.write(_ERROR_OUTPUT, b"\nstopping after this step; Ctrl-C once more stops at once\n")
