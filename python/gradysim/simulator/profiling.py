"""Reports on a run: wall time by kind of event, and how well real time was kept."""

import csv
import logging
import time
from pathlib import Path

from gradysim.simulator.event import ScheduledEvent
from gradysim.simulator.log import format_table

_logger = logging.getLogger(__name__)


class EventProfile:
    """Runs events and adds up their wall times."""

    def __init__(self) -> None:
        self._totals: dict[str, list[float]] = {}

    def run(self, event: ScheduledEvent) -> None:
        """Call the event's callback and add up its wall time."""
        callback, context = event
        start = time.perf_counter()
        try:
            callback()
        finally:
            total = self._totals.setdefault(context, [0, 0.0])
            total[0] += 1
            total[1] += time.perf_counter() - start

    def report(self) -> None:
        """Log the table, most expensive first. It is a warning, so that a quiet log shows it, too."""
        rows = [
            [context, f"{count:.0f}", f"{total_s:.6f}", f"{total_s / count:.3e}"]
            for context, (count, total_s) in sorted(self._totals.items(), key=lambda item: -item[1][1])
        ]
        table = format_table(["Context", "Total count", "Total time (s)", "Average time (s)"], rows)
        _logger.warning("[--------- Profiling information ---------]\n%s", table)


COLUMNS = ("iteration", "simulation_time", "real_time", "time_until_next_event", "time_drift")
"""All but the first in seconds: simulated time of the event, wall time since the start when it began, how far
ahead of it the simulation was before waiting, and how late it began."""


class TimingReport:
    """Writes one line for each event, as it happens."""

    def __init__(self, path: Path, factor: float) -> None:
        """Create the file at `path`, for a simulation at `factor` times real time."""
        self._path = path.absolute()
        self._factor = factor
        self._file = path.open("w", newline="", encoding="utf-8")
        self._writer = csv.writer(self._file, lineterminator="\n")
        self._writer.writerow(COLUMNS)
        self._last = (0.0, 0.0)
        self._ahead = _Column()
        self._drift = _Column()

    def note(self, iteration: int, simulation_s: float, real_s: float, ahead_s: float, late_s: float) -> None:
        """Write the line of one event."""
        self._writer.writerow((iteration, simulation_s, real_s, ahead_s, late_s))
        self._last = (simulation_s, real_s)
        self._ahead.note(ahead_s)
        self._drift.note(late_s)

    def log_summary(self) -> None:
        """Log the last, mean and largest values."""
        simulation_s, real_s = self._last
        table = format_table(
            ["Metric", "Last (s)", "Mean (s)", "Max (s)"],
            [["time_until_next_event", *self._ahead.cells()], ["time_drift", *self._drift.cells()]],
        )
        reached = f"{simulation_s / real_s:.4f}" if real_s > 0 else "unknown"
        _logger.info(
            "Timing report\n%s\nreal_time: %g requested, %s reached; all events: %s",
            table,
            self._factor,
            reached,
            self._path,
        )

    def close(self) -> None:
        """Close the file; no-op if it is closed."""
        self._file.close()


class _Column:
    def __init__(self) -> None:
        self._count = 0
        self._sum = self._last = 0.0
        self._greatest = -float("inf")

    def note(self, value: float) -> None:
        self._count += 1
        self._sum += value
        self._last = value
        self._greatest = max(self._greatest, value)

    def cells(self) -> list[str]:
        if self._count == 0:
            return ["-"] * 3
        return [f"{value:.4f}" for value in (self._last, self._sum / self._count, self._greatest)]
