"""Where the time of a run went: counts and wall times of its events, by context."""

import logging
import time

from gradysim.simulator.event import ScheduledEvent
from gradysim.simulator.log import format_table

_logger = logging.getLogger(__name__)


class EventProfile:
    """Runs events and keeps the books."""

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
        """Log the table as a warning, so that it is seen however quiet the log is; most expensive first."""
        rows = [
            [context, f"{count:.0f}", f"{total_s:.6f}", f"{total_s / count:.3e}"]
            for context, (count, total_s) in sorted(self._totals.items(), key=lambda item: -item[1][1])
        ]
        table = format_table(["Context", "Total count", "Total time (s)", "Average time (s)"], rows)
        _logger.warning("[--------- Profiling information ---------]\n%s", table)
