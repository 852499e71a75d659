"""Interface of handlers."""

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

from gradysim.simulator.event import EventLoop
from gradysim.simulator.node import Node

if TYPE_CHECKING:
    import asyncio


class INodeHandler(ABC):
    """One aspect of the simulated world, for all nodes.

    A simulation calls `inject`, then `register_node` for each node, and `initialize` once. It calls
    `finalize` once, after the last event.

    Attributes:
        paused_s: Wall seconds for which the handler has paused the simulation since the last `initialize`. A
            simulation in real time does not catch up on them.
    """

    paused_s: float = 0.0

    @staticmethod
    @abstractmethod
    def get_label() -> str:
        """Return the label of the handler, which is unique in a simulation."""

    @abstractmethod
    def inject(self, event_loop: EventLoop) -> None:
        """Take the event loop of a new simulation, and forget the nodes of an earlier one."""

    @abstractmethod
    def register_node(self, node: Node[Any]) -> None:
        """Add a node of the simulation."""

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
    """A handler that waits with asyncio for the outside world.

    The simulation owns the asyncio loop and runs it before each event: in real time until the event is due,
    otherwise for one turn. The loop does not run during an event or a method of a handler. So these can call
    `asyncio_loop.run_until_complete`, or start a task with `asyncio_loop.create_task`. A task may schedule
    events. An unhandled exception of a task ends the simulation. After the last `finalize` the remaining
    tasks are canceled and the loop is closed.
    """

    def inject_async(self, asyncio_loop: "asyncio.AbstractEventLoop", real_time: float) -> None:
        """Take the asyncio loop of a new simulation; called after `inject`.

        Args:
            asyncio_loop: The loop, which is not running yet.
            real_time: Simulated seconds per wall second; 0 if the simulation runs at full speed.
        """
        return
