"""The progress bar of a run: simulated time, speed, remaining time."""

import math
import sys
from typing import Self

from rich.console import Console
from rich.progress import BarColumn, Progress, ProgressColumn, Task, TextColumn, TimeRemainingColumn
from rich.table import Column
from rich.text import Text


class SimulatedTimeColumn(ProgressColumn):
    """`120 of 7,200 s`."""

    def render(self, task: Task) -> Text:
        """Return the simulated time reached, and its limit if there is one."""
        limit = "" if task.total is None else f" of {task.total:,.0f}"
        return Text(f"{task.completed:,.0f}{limit} s")


class SpeedColumn(ProgressColumn):
    """`585 x real time`: simulated seconds per second of wall time."""

    def render(self, task: Task) -> Text:
        """Return the speed of the last seconds; nothing until it is known."""
        if task.speed is None:
            return Text()
        digits = f"{task.speed:,.3g}" if task.speed < 999.5 else f"{task.speed:,.0f}"
        return Text(f"{digits} x real time")


class RunProgress:
    """A bar on `console` that `update` moves; it is gone when the `with` block ends.

    It draws only when `update` is called, so it needs no thread.
    """

    def __init__(self, console: Console, title: str, limit_s: float) -> None:
        """Prepare a bar for a run of `limit_s` simulated seconds, which may be infinite."""
        self._bar = Progress(
            TextColumn("{task.description}", markup=False, table_column=Column(no_wrap=True)),
            BarColumn(),
            SimulatedTimeColumn(table_column=Column(no_wrap=True)),
            SpeedColumn(table_column=Column(no_wrap=True)),
            TimeRemainingColumn(table_column=Column(no_wrap=True)),
            TextColumn("left"),
            console=console,
            auto_refresh=False,
            transient=True,
            redirect_stdout=sys.stdout.isatty(),
        )
        self._task = self._bar.add_task(title, total=limit_s if math.isfinite(limit_s) else None)

    def __enter__(self) -> Self:
        self._bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._bar.stop()

    def update(self, sim_time_s: float) -> None:
        """Show that the run has reached `sim_time_s` seconds of simulated time."""
        self._bar.update(self._task, completed=sim_time_s, refresh=True)
