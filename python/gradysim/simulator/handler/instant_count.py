"""Notices a node that goes on and on within one instant, so that simulated time stands still.

A timer that is set for now again and again, or messages without delay that answer each other, never end: the
run would hang without a word. Counted is only what is scheduled for `EventLoop.crowded_instant`, when tens of
thousands of events have run at that instant already, so that it costs nothing elsewhere.
"""

import math

MOST_AT_ONE_INSTANT = 1_000_000
"""Timers, or messages, of one node; the engine has the same bound. Floods stay far below: where each of a
thousand nodes floods a message, each node sends a thousand."""


class InstantCount:
    """Counts what one node does at the present instant."""

    __slots__ = ("_count", "_instant")

    def __init__(self) -> None:
        self._instant = -math.inf
        self._count = 0

    def exceeds(self, now: float) -> bool:
        """Count one more at that time, in simulated seconds; whether they are more than can be meant."""
        if now != self._instant:
            self._instant = now
            self._count = 0
        self._count += 1
        return self._count > MOST_AT_ONE_INSTANT
