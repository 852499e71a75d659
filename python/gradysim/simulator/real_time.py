"""Simulated time at the pace of the wall clock, for both modes."""

import time
from collections.abc import Iterator
from contextlib import contextmanager

from gradysim.protocol.checked_values import is_in_range


def real_time_factor(real_time: bool | float) -> float:
    """Return the number of simulated seconds per wall second; 0 for full speed.

    Raise ValueError if it is neither a bool nor a finite factor >= 0.
    """
    if not isinstance(real_time, bool) and not is_in_range(real_time, 0):
        raise ValueError(f"real_time must be a bool or a finite factor >= 0, got {real_time!r}")
    return float(real_time)


class RealTimePacer:
    """Compares simulated time with the wall clock, counted from the start, so that delays do not add up.

    Attributes:
        paused_s: Wall seconds of pauses, which the simulation does not catch up on.
    """

    def __init__(self, factor: float) -> None:
        """Start now, with `factor` (> 0) simulated seconds per wall second."""
        self._factor = factor
        self._start = time.monotonic()
        self.paused_s = 0.0

    @property
    def elapsed_s(self) -> float:
        """Wall seconds since the start, without pauses."""
        return time.monotonic() - self._start - self.paused_s

    def due_s(self, ahead_s: float = 0.0) -> float:
        """Return the simulated time that is due now, or in `ahead_s` wall seconds."""
        return (self.elapsed_s + ahead_s) * self._factor

    def remaining_s(self, simulated_s: float) -> float:
        """Return the wall seconds until a simulated time; negative when it is past."""
        return simulated_s / self._factor - self.elapsed_s

    def wait_until(self, simulated_s: float) -> None:
        """Sleep until the wall clock reaches a simulated time; no-op when it is past."""
        remaining = self.remaining_s(simulated_s)
        if remaining > 0:
            time.sleep(remaining)


_contexts = 0


@contextmanager
def full_speed() -> Iterator[None]:
    """Let simulations start at full speed inside the block, for scripts that test or train.

    The state is global, as in gradysim 0.8. The code that builds a simulation need not know of it.
    """
    global _contexts
    _contexts += 1
    try:
        yield
    finally:
        _contexts -= 1


def is_full_speed() -> bool:
    """Return whether a `full_speed` block is active."""
    return _contexts > 0
