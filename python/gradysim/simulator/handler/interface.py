"""What a simulation expects of each of its handlers."""

from abc import ABC, abstractmethod
from typing import Any

from gradysim.simulator.event import EventLoop
from gradysim.simulator.node import Node


class INodeHandler(ABC):
    """One aspect of the world, for all nodes.

    A simulation calls `inject`, then `register_node` for each node, `initialize` once, and after its last
    event `finalize` once.
    """

    @staticmethod
    @abstractmethod
    def get_label() -> str:
        """Return the name under which others find the handler; a simulation has one handler of each name."""

    @abstractmethod
    def inject(self, event_loop: EventLoop) -> None:
        """Take the event loop of a new simulation; nodes of an earlier one are forgotten."""

    @abstractmethod
    def register_node(self, node: Node[Any]) -> None:
        """Take a node of the simulation."""

    def initialize(self) -> None:
        """Called before the first event, and before the protocols' `initialize`."""
        return

    def after_simulation_step(self, iteration: int, timestamp: float) -> None:
        """Called after each event, number `iteration` from 0 on, at `timestamp` seconds of simulated time."""
        return

    def finalize(self) -> None:
        """Called after the last event, and after the protocols' `finish`."""
        return
