"""Simulated time at the pace of the wall clock, for both modes."""

import time
from types import TracebackType
from typing import Self

from gradysim.protocol.checked_values import is_in_range


def real_time_factor(real_time: bool | float) -> float:
    """Return how many simulated seconds go by in a wall second; 0 for full speed.

    Raises:
        ValueError: It is neither a bool nor a finite factor >= 0.
    """
    if not isinstance(real_time, bool) and not is_in_range(real_time, 0):
        raise ValueError(f"real_time must be a bool or a finite factor >= 0, got {real_time!r}")
    return float(real_time)


class RealTimePacer:
    """Tells how long the wall clock is behind the simulation, counted from the start: delays do not add up.

    Attributes:
        held_up_s: Wall seconds for which the simulation was held up on purpose, as by a pause; these are not
            caught up on.
    """

    def __init__(self, factor: float) -> None:
        """Let `factor` simulated seconds, > 0, go by in each second of wall time; it starts now."""
        self._factor = factor
        self._start = time.monotonic()
        self.held_up_s = 0.0

    @property
    def elapsed_s(self) -> float:
        """Wall seconds since the start, without those that the simulation was held up."""
        return time.monotonic() - self._start - self.held_up_s

    def due_s(self, ahead_s: float = 0.0) -> float:
        """Simulated time that it is now, or will be in `ahead_s` wall seconds."""
        return (self.elapsed_s + ahead_s) * self._factor

    def remaining_s(self, simulated_s: float) -> float:
        """Wall seconds until a simulated time; negative when it is past."""
        return simulated_s / self._factor - self.elapsed_s

    def wait_until(self, simulated_s: float) -> None:
        """Sleep until the wall clock has reached a simulated time; return at once when it is past."""
        remaining = self.remaining_s(simulated_s)
        if remaining > 0:
            time.sleep(remaining)


_contexts = 0


class FullSpeed:
    """Simulations that start in this context do not wait."""

    def __enter__(self) -> Self:
        global _contexts
        _contexts += 1
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        exception: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        global _contexts
        _contexts -= 1


def is_full_speed() -> bool:
    """Return whether this is in such a context."""
    return _contexts > 0
