"""What a command is at, on a terminal, while it reads and builds: `building 1,000,000 nodes, 12 s`."""

import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from time import monotonic
from typing import Protocol, TextIO

FIRST_AFTER_S = 2.0
EVERY_S = 1.0
"""Wall time until it says something, and until it says so again."""


class Ending(Protocol):
    """A `threading.Event`, or what stands for one in tests."""

    def wait(self, timeout: float) -> bool:
        """Wait for it, so long at most; return whether it came."""


@contextmanager
def waiting(what: str, *, shown: bool) -> Iterator[None]:
    """Tell on the error output that it is at `what`, if it takes seconds, `shown` and that is a terminal."""
    if not (shown and sys.stderr.isatty()):
        yield
        return
    ended = threading.Event()
    thread = threading.Thread(target=tell_until, args=(ended, what, sys.stderr), daemon=True)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()


def tell_until(ended: Ending, what: str, terminal: TextIO) -> None:
    """Say it again and again in one line, which is empty in the end."""
    began = monotonic()
    line = ""
    with suppress(OSError):  # a terminal that has gone is no reason to stop
        while not ended.wait(EVERY_S if line else FIRST_AFTER_S):
            line = f"{what}, {monotonic() - began:.0f} s"
            print(f"\r{line}", end="", file=terminal, flush=True)
        if line:
            print(f"\r{' ' * len(line)}\r", end="", file=terminal, flush=True)
