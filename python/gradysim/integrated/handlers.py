"""Handlers of the published interface beside the engine: assertions, viewers, and users' own.

The engine is what the communication, timer and mobility handlers are in prototype mode. Every other handler
needs an event loop, nodes to look at and its turn at the right moments, which it is given here in the same
order as there.
"""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, cast

from gradysim.encapsulator.netsim import NetsimEncapsulator
from gradysim.integrated.event_loop import EngineEventLoop
from gradysim.integrated.native_protocols import NativeView
from gradysim.integrated.node_view import NodeView
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
    """Return `handlers` by their labels; TypeError or ValueError for one that cannot work here."""
    world = "the engine is its {label}, set in the scenario"
    return handlers_by_label(handlers, MODE, world, asynchronous=False)


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
        """Show every handler one more node."""
        if self.by_label:
            view = cast("SimulatorNode[Any]", NodeView(node, encapsulator, seed))
            for handler in self.by_label.values():
                handler.register_node(view)

    def initialize(self) -> None:
        """Begin; before the protocols do."""
        for handler in self.by_label.values():
            self._live.append(handler)
            handler.initialize()

    @property
    def held_up_s(self) -> float:
        """Wall seconds for which the handlers held the run up on purpose."""
        return sum(getattr(handler, "held_up_s", 0.0) for handler in self.by_label.values())

    def run_until(self, limit_s: float, max_events: int) -> bool:
        """Run at most so many events up to `limit_s`, and say whether that was all of them.

        If a handler wants its turn after every event, the events are run one at a time.
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
        """End; after the protocols have. Unless the run is complete, assertions judge nothing more."""
        if not complete:
            stop_judging(self._live)
        while self._live:
            self._live.pop(0).finalize()

    def finalize_after_failure(self) -> None:
        """End those that are left; what they raise is logged, and does not hide the failure before."""
        finalize_after_failure(self._live)
