"""Keeps a simulation from running ahead of the wall clock."""

import time


class RealTimePacer:
    """Waits until the time of each event has come, counted from the start: delays do not add up."""

    def __init__(self, factor: float) -> None:
        """Let `factor` simulated seconds, > 0, go by in each second of wall time."""
        self._factor = factor
        self._start = time.monotonic()

    def wait_until(self, simulated_s: float) -> None:
        """Sleep until the wall clock has reached a simulated time; return at once when it is past."""
        remaining = self._start + simulated_s / self._factor - time.monotonic()
        if remaining > 0:
            time.sleep(remaining)
