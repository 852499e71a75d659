"""What a simulation expects of each of its handlers."""

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

from gradysim.simulator.event import EventLoop
from gradysim.simulator.node import Node

if TYPE_CHECKING:
    import asyncio


class INodeHandler(ABC):
    """One aspect of the world, for all nodes.

    A simulation calls `inject`, then `register_node` for each node, `initialize` once, and after its last
    event `finalize` once.

    Attributes:
        held_up_s: Wall seconds for which the handler held the simulation up on purpose, as a pause does,
            since the last `initialize`; a simulation in real time does not try to catch up on them.
    """

    held_up_s: float = 0.0

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


class IAsyncNodeHandler(INodeHandler):
    """A handler that waits for the world outside with asyncio.

    The simulation owns the asyncio loop. It runs the loop before each event, in real time until that event is
    due, otherwise for one turn; it does not run while an event or a method of a handler does, so these can
    use `asyncio_loop.run_until_complete`, or leave a task with `asyncio_loop.create_task`. A task may
    schedule events; an exception that nobody takes from its task ends the simulation. After the last
    `finalize` the remaining tasks are cancelled and the loop is closed.
    """

    def inject_async(self, asyncio_loop: "asyncio.AbstractEventLoop", real_time: float) -> None:
        """Take the asyncio loop of a new simulation; called after `inject`.

        Args:
            asyncio_loop: Does not run yet.
            real_time: Simulated seconds for each wall second; 0 if the simulation runs at full speed.
        """
        return
