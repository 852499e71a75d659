"""Handlers that watch a run of the engine: assertions, viewers, and users' own.

The engine replaces the communication, timer and mobility handlers of prototype mode. All other handlers get
an event loop, nodes and their calls here, in the same order as in prototype mode.
"""

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, cast

from gradysim.encapsulator.netsim import NetsimEncapsulator
from gradysim.integrated.native_protocols import NativeView
from gradysim.protocol.position import Position
from gradysim.simulator.event import EventLoopException
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.handler.registry import (
    finalize_after_failure,
    handlers_by_label,
    step_hooks,
    stop_judging,
)

if TYPE_CHECKING:
    from gradysim._netsim import Network, Node
    from gradysim.simulator.event import EventLoop
    from gradysim.simulator.node import Node as SimulatorNode

MODE = "integrated mode"


def checked_handlers(handlers: Iterable[INodeHandler]) -> dict[str, INodeHandler]:
    """Return `handlers` by their labels. TypeError or ValueError for one that cannot work here."""
    world = "the engine is its {label}, set in the scenario"
    return handlers_by_label(handlers, MODE, world, asynchronous=False)


class EngineEventLoop:
    """Event loop of the engine, for `INodeHandler.inject`; the counterpart of `simulator.event.EventLoop`.

    The engine runs the events: handlers cannot pop or cancel them.
    """

    def __init__(self, network: "Network") -> None:
        self._network = network

    @property
    def current_time(self) -> float:
        """Simulated time in seconds."""
        return self._network.now

    def __len__(self) -> int:
        """Return the number of pending events: those of the network, and those of all handlers."""
        return self._network.pending_count

    def schedule_event(
        self, timestamp: float, callback: Callable[[], Any], context: str = ""
    ) -> tuple[Callable[[], Any], str]:
        """Call `callback()` at `timestamp`, after all events scheduled for that time so far.

        The absolute simulated time (s) is rounded to ps. `context` is not used in this mode.
        Raise EventLoopException if the time is in the past or not a time, or the callback is not callable.
        """
        if not callable(callback):
            raise EventLoopException(f"an event's callback must be callable, got {callback!r}")
        try:
            self._network.schedule(timestamp, callback)
        except (TypeError, RuntimeError) as error:  # the engine's SimulationError is one
            raise EventLoopException(
                f"cannot schedule an event at {timestamp!r}: expected a finite number of seconds, "
                f"at or after the current time, {self.current_time} s"
            ) from error
        return (callback, context)

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(
            f"the event loop has no {name!r} in integrated mode, where the engine runs the events: handlers "
            "use schedule_event, current_time and len()"
        )


class NodeView:
    """Node of the engine, for `INodeHandler.register_node`; the counterpart of `simulator.node.Node`.

    Attributes:
        id: Unique in the network.
        protocol_encapsulator: Holds its protocol.
        seed: Seed of the run.
    """

    def __init__(
        self, node: "Node", protocol_encapsulator: NetsimEncapsulator[Any] | NativeView, seed: int
    ) -> None:
        self.id = node.id
        self.protocol_encapsulator = protocol_encapsulator
        self.seed = seed
        self._node = node

    @property
    def position(self) -> Position:
        """Current (x, y, z) in meters. It cannot be set: the engine moves the nodes."""
        return self._node.position

    @position.setter
    def position(self, _: Position) -> None:
        raise AttributeError(
            f"the position of node {self.id} cannot be set in integrated mode, where the engine moves "
            "the nodes: a handler that moves them works in prototype mode only; a protocol sends mobility "
            "commands"
        )


class EngineHandlers:
    """The handlers of one run.

    Attributes:
        by_label: The handlers.
    """

    def __init__(self, handlers: Iterable[INodeHandler], network: "Network") -> None:
        """Inject the event loop; raises as `checked_handlers`."""
        self.by_label = checked_handlers(handlers)
        self._network = network
        self._hooks = step_hooks(self.by_label.values())
        self._live: list[INodeHandler] = []  # those to be finalized
        for handler in self.by_label.values():
            handler.inject(cast("EventLoop", EngineEventLoop(network)))

    def register_node(
        self, node: "Node", encapsulator: NetsimEncapsulator[Any] | NativeView, seed: int
    ) -> None:
        """Register one more node with every handler."""
        if self.by_label:
            view = cast("SimulatorNode[Any]", NodeView(node, encapsulator, seed))
            for handler in self.by_label.values():
                handler.register_node(view)

    def initialize(self) -> None:
        """Initialize the handlers, before the protocols."""
        for handler in self.by_label.values():
            self._live.append(handler)
            handler.initialize()

    @property
    def paused_s(self) -> float:
        """Wall time for which handlers paused the run, in seconds."""
        return sum(getattr(handler, "paused_s", 0.0) for handler in self.by_label.values())

    def run_until(self, limit_s: float, max_events: int) -> bool:
        """Run at most `max_events` events up to `limit_s`; return whether these were all.

        The events are run one at a time if a handler is called after each of them.
        """
        network, hooks = self._network, self._hooks
        if not hooks:
            return network.run_until(limit_s, max_events)
        for _ in range(max_events):
            if not network.step(limit_s):
                return network.run_until(limit_s)  # sets the clock
            iteration, timestamp = network.event_count - 1, network.now
            for hook in hooks:
                hook(iteration, timestamp)
        return False

    def finalize(self, *, complete: bool = True) -> None:
        """Finalize the handlers, after the protocols. Assertions are checked only if the run is complete."""
        if not complete:
            stop_judging(self._live)
        while self._live:
            self._live.pop(0).finalize()

    def finalize_after_failure(self) -> None:
        """Finalize the remaining handlers; their exceptions are logged and do not hide the earlier one."""
        finalize_after_failure(self._live)
