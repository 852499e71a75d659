"""Progress on a terminal: `building 1,000,000 nodes, 12 s`, and the progress bar of a run."""

import math
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from time import monotonic
from typing import TYPE_CHECKING, Protocol, Self, TextIO

if TYPE_CHECKING:
    from rich.console import Console

FIRST_AFTER_S = 2.0
EVERY_S = 1.0
"""Wall time until the first report, and between two reports."""


class Ending(Protocol):
    """A `threading.Event`, or a replacement in tests."""

    def wait(self, timeout: float) -> bool:
        """Wait for the event, at most this long; return whether it was set."""


@contextmanager
def waiting(what: str, *, shown: bool) -> Iterator[None]:
    """Print `what` to standard error while it takes seconds, if `shown` and on a terminal."""
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
    """Print it repeatedly in one line, and clear the line at the end."""
    began = monotonic()
    line = ""
    with suppress(OSError):  # a closed terminal is not a reason to stop
        while not ended.wait(EVERY_S if line else FIRST_AFTER_S):
            line = f"{what}, {monotonic() - began:.0f} s"
            print(f"\r{line}", end="", file=terminal, flush=True)
        if line:
            print(f"\r{' ' * len(line)}\r", end="", file=terminal, flush=True)


class RunProgress:
    """A bar on `console` that `update` moves: simulated time, speed and remaining time, or a number of runs.

    It disappears at the end of the `with` block. It draws only in `update`, so it needs no thread.
    """

    def __init__(self, console: "Console", title: str, limit: float, unit: str = "s") -> None:
        """Prepare a bar up to `limit` simulated seconds, which may be infinite, or another `unit`."""
        from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn
        from rich.table import Column

        self._limit = f" of {limit:,.0f}" if math.isfinite(limit) else ""
        self._unit = unit
        self._bar = Progress(
            TextColumn("{task.description}", markup=False, table_column=Column(no_wrap=True)),
            BarColumn(),
            TextColumn("{task.fields[reached]}", table_column=Column(no_wrap=True)),
            TextColumn("{task.fields[speed]}", table_column=Column(no_wrap=True)),
            TimeRemainingColumn(table_column=Column(no_wrap=True)),
            TextColumn("left"),
            console=console,
            auto_refresh=False,
            transient=True,
            redirect_stdout=sys.stdout.isatty(),
        )
        total = limit if math.isfinite(limit) else None
        self._task = self._bar.add_task(title, total=total, reached="", speed="")

    def __enter__(self) -> Self:
        with suppress(OSError):  # a closed terminal is not a reason to stop, here and below
            self._bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        with suppress(OSError):
            self._bar.stop()

    def update(self, reached: float) -> None:
        """Show that this simulated time in s, or this number, has been reached."""
        with suppress(OSError):
            self._bar.update(
                self._task,
                completed=reached,
                reached=f"{reached:,.0f}{self._limit} {self._unit}",
                speed=text_of_speed(self._bar.tasks[0].speed) if self._unit == "s" else "",
                refresh=True,
            )


def text_of_speed(speed: float | None) -> str:
    """Return `585 x real time`: simulated seconds per second of wall time; "" until it is known."""
    if speed is None:
        return ""
    return f"{speed:,.3g} x real time" if speed < 999.5 else f"{speed:,.0f} x real time"
