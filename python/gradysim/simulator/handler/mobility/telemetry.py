"""When which nodes are told their position."""

import math
from collections.abc import Callable
from typing import Any

from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.simulator.event import ScheduledEvent
from gradysim.simulator.log import label_node
from gradysim.simulator.node import Node


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

    def add(self, node: Node[Any]) -> None:
        """Let one more node have telemetry."""
        self.deliveries.append((_delivery(node), f"{label_node(node)} handle_telemetry"))

    def is_due(self, update: int) -> bool:
        """Whether telemetry comes with this update, the first one being 1; to be asked of each in turn.

        Those before the one that is `due` may be left out.

        An interval that is no whole number of updates is kept on average: telemetry comes with the first
        update at or after its time.
        """
        if update < self.due:
            return False
        self._count += 1
        self.due = math.ceil(self._count * self._interval)
        return True


def _delivery(node: Node[Any]) -> Callable[[], None]:
    def deliver() -> None:
        node.protocol_encapsulator.handle_telemetry(Telemetry(node.position))

    return deliver
