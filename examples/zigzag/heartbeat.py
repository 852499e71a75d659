"""Times of heartbeats."""

import math
from random import Random


class HeartbeatClock:
    """Times of a node's heartbeats: number k is sent at k * interval + a random delay of up to `jitter`.

    All nodes count from time zero. Without jitter they send at exactly the same instants. On a real channel
    such heartbeats are never received, since a radio that transmits does not receive.

    Args:
        interval: Seconds between two heartbeats, > 0.
        jitter: Longest random delay in seconds, 0 (none) to `interval`.
        start: The first heartbeat is the first one after this time in seconds.
        random: Random stream for the delays.
    """

    def __init__(self, interval: float, jitter: float, start: float, random: Random) -> None:
        if not interval > 0:
            raise ValueError(f"heartbeat_interval is {interval} s, expected more than 0 s")
        if not 0 <= jitter <= interval:
            raise ValueError(f"heartbeat_jitter is {jitter} s, expected 0 s to the interval, {interval} s")
        self._interval = interval
        self._jitter = jitter
        self._random = random
        self._number = math.floor(start / interval)

    def next(self) -> float:
        """Return the time of the next heartbeat in seconds."""
        self._number += 1
        return self._number * self._interval + self._random.uniform(0, self._jitter)
