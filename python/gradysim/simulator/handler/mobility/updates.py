"""Times of the position updates, and the telemetry that follows them."""

import math
from bisect import bisect_left
from collections.abc import Callable
from typing import Any

from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.position import Position
from gradysim.simulator.event import ScheduledEvent
from gradysim.simulator.log import context_of
from gradysim.simulator.node import Node


class UpdateTimes:
    """Times of periodic updates, counted from a start, so that rounding errors do not add up."""

    def __init__(self, update_rate_s: float, start_s: float = 0.0) -> None:
        """Let the first update come one `update_rate_s`, > 0, after `start_s` (simulated seconds)."""
        self._update_rate_s = update_rate_s
        self._frequency = _whole_frequency(update_rate_s)
        self._start_s = start_s

    def time_of(self, update: int) -> float:
        """Return the simulated time in seconds of an update, the first one being 1."""
        if self._frequency is None:
            return self._start_s + update * self._update_rate_s
        return self._start_s + update / self._frequency

    def last_before(self, timestamp: float, updates: range) -> int:
        """Return the last of these updates that comes before a time; the first of them if none does."""
        return updates[max(bisect_left(updates, timestamp, key=self.time_of) - 1, 0)]


def _whole_frequency(update_rate_s: float) -> float | None:
    """Return the updates per second if they are an integer.

    35 / 100 equals the literal 0.35, and 35 * 0.01 does not. With a division, updates meet timers of that
    time.
    """
    if update_rate_s < 1e-9:
        return None
    frequency = round(1 / update_rate_s)
    return float(frequency) if frequency > 0 and 1 / frequency == update_rate_s else None


class TelemetryGroup:
    """Nodes with the same telemetry interval, in units of the mobility's updates.

    Attributes:
        deliveries: One event per node, scheduled again and again.
        due: Number of the update with which telemetry comes next.
    """

    def __init__(self, interval_updates: float) -> None:
        """Serve nodes that get telemetry every `interval_updates` updates, a number >= 1."""
        self._interval = interval_updates
        self._count = 1
        self.due = math.ceil(interval_updates)
        self.deliveries: list[ScheduledEvent] = []

    def add(self, node: Node[Any], reported_position: Callable[[], Position] | None = None) -> None:
        """Add a node. `reported_position` returns what it learns; None for its position."""
        self.deliveries.append((_delivery(node, reported_position), context_of(node, "handle_telemetry")))

    def is_due(self, update: int) -> bool:
        """Return whether telemetry comes with this update; the first one is 1. Call it for each in order.

        Updates before `due` may be skipped. If the interval is not an integer number of updates, telemetry
        comes with the first update at or after its time.
        """
        if update < self.due:
            return False
        self._count += 1
        self.due = math.ceil(self._count * self._interval)
        return True


def _delivery(node: Node[Any], reported_position: Callable[[], Position] | None) -> Callable[[], None]:
    def deliver() -> None:
        node.protocol_encapsulator.handle_telemetry(Telemetry(node.position))

    def deliver_reported() -> None:
        assert reported_position is not None
        node.protocol_encapsulator.handle_telemetry(Telemetry(reported_position()))

    return deliver if reported_position is None else deliver_reported
