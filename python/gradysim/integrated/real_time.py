"""A run of the engine at the pace of the wall clock, for viewers."""

from collections.abc import Callable

from gradysim.simulator.real_time import RealTimePacer

TURN_S = 0.01
"""Wall time between two readings of the clock, in seconds. Events are up to this late, and never early."""


class RealTimeRun:
    """Runs the events that are due, and waits."""

    def __init__(
        self,
        run_until: Callable[[float, int], bool],
        factor: float,
        paused_s: Callable[[], float],
    ) -> None:
        """Start the clock, with `factor` simulated seconds in each wall second.

        `run_until` runs all events up to a simulated time (s), up to a number of events, and returns whether
        it reached that time. `paused_s` returns the wall time (s) for which handlers paused the run.
        """
        self._run_until = run_until
        self._pacer = RealTimePacer(factor)
        self._paused_s = paused_s
        self._due_s = 0.0

    def advance(self, until_s: float, max_events: int) -> bool:
        """Run at most `max_events` events that are due, then wait; return whether `until_s` is reached."""
        pacer = self._pacer
        pacer.paused_s = self._paused_s()
        self._due_s = min(max(self._due_s, pacer.due_s()), until_s)
        if not self._run_until(self._due_s, max_events):
            return False
        if self._due_s >= until_s:
            return True
        pacer.paused_s = self._paused_s()
        # Events up to this time are due after the wait, whatever the rounding.
        self._due_s = min(pacer.due_s(TURN_S), until_s)
        pacer.wait_until(self._due_s)
        return False
