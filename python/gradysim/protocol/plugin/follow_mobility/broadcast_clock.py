"""When a leader broadcasts."""

import math
from random import Random


class BroadcastClock:
    """Once in each interval, at a random moment of its first part.

    Broadcast k = 1, 2, ... is due at start + k * interval + a random delay, uniform between 0 and
    jitter * interval. So the mean time between two broadcasts is the interval, and never adds up to a drift.

    Why random: nodes that are made together would send at the same instants for ever. A radio that transmits
    receives nothing, and of two frames on the air at once none arrives.
    """

    def __init__(self, interval: float, jitter: float, start: float, random: Random) -> None:
        """Start to count at `start`, s; `interval` in s, > 0; `jitter` 0 to 1."""
        self._interval = interval
        self._jitter = jitter
        self._start = start
        self._random = random
        self._number = 0

    def next(self, now: float) -> float:
        """Time of the next broadcast, s, >= `now`. Intervals that have gone by unused are left out."""
        # Not quite: a broadcast at the very end of its interval, rounded up, has not used up the next one.
        elapsed = math.ceil((now - self._start) / self._interval - 1e-6)
        self._number = max(self._number + 1, elapsed)
        delay = self._random.uniform(0, self._jitter)
        return max(now, self._start + (self._number + delay) * self._interval)
