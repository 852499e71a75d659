"""What a Raft node needs of the world around it."""

from random import Random
from typing import Protocol


class Environment(Protocol):
    """Clock, timers, radio and chance of one node."""

    @property
    def node_id(self) -> int:
        """Id of the node, >= 0, unique in the network."""

    @property
    def random(self) -> Random:
        """The node's stream of random numbers."""

    def now_s(self) -> float:
        """Time in seconds."""

    def send(self, message: str, destination: int | None) -> None:
        """Send to one node, or to everybody in reach if `destination` is None. It may be lost."""

    def set_timer(self, name: str, delay_s: float) -> None:
        """Have the node's `handle_timer(name)` called after `delay_s` seconds."""

    def cancel_timer(self, name: str) -> None:
        """Forget all pending timers of that name."""
