"""The computers that run the protocols of nodes: they take time for each event, and events wait in order."""

import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

from gradysim.encapsulator.random_stream import Purpose, RandomStream
from gradysim.simulator.event import EventLoop, time_after
from gradysim.simulator.handler.communication import DeliveryLedger
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.log import context_of
from gradysim.simulator.node import Node

_LONGEST_S = 1e6


class ProcessingTime:
    """The time that a computer takes for an event: log-normal, with a random stream of its own.

    The engine draws the same numbers: cpp/netsim/node/processing_time.hpp.
    """

    def __init__(self, median_s: float, spread: float = 0.0) -> None:
        """`spread` is the standard deviation of the natural logarithm; with 0, each takes `median_s`."""
        self.median_s = median_s
        self.spread = spread

    def draw_s(self, stream: RandomStream) -> float:
        """Draw the time of one event, in seconds.

        Source: G. E. P. Box, M. E. Muller, "A note on the generation of random normal deviates", 1958.
        """
        if self.spread == 0:
            return self.median_s
        radius = math.sqrt(-2 * math.log(1 - stream.random()))
        angle = 2 * math.pi * stream.random()
        return min(self.median_s * math.exp(self.spread * radius * math.cos(angle)), _LONGEST_S)


@dataclass(slots=True)
class _Event:
    """An event of a protocol.

    Attributes:
        callback: Name of the callback; "" for a canceled timer, or one that is under way.
        argument: Argument of the callback.
        handled: Called when it has been processed.
    """

    callback: str
    argument: Any
    handled: Callable[[], None] | None = None


class _Computer:
    """The computer of one node. It replaces callbacks of the node's encapsulator, and calls them later."""

    def __init__(
        self, node: Node[Any], time: ProcessingTime, event_loop: EventLoop, ledger: DeliveryLedger | None
    ) -> None:
        self._node = node
        self._time = time
        self._event_loop = event_loop
        self._ledger = ledger
        self._stream = RandomStream(node.seed, node.id, Purpose.PROCESSING)
        self._events: deque[_Event] = deque()  # the first one is being processed
        encapsulator = node.protocol_encapsulator
        self._callbacks: dict[str, Callable[[Any], None]] = {"": lambda _: None}
        for name, add in (
            ("handle_timer", partial(self._add, "handle_timer")),
            ("handle_packet", self._add_packet),
            ("handle_telemetry", self._add_telemetry),
        ):
            self._callbacks[name] = getattr(encapsulator, name)
            setattr(encapsulator, name, add)  # hides the method of the class
        self._cancel = encapsulator.provider.cancel_timer
        encapsulator.provider.cancel_timer = self._cancel_timer

    def _add(self, callback: str, argument: Any, handled: Callable[[], None] | None = None) -> None:
        self._events.append(_Event(callback, argument, handled))
        if len(self._events) == 1:
            self._begin_next()

    def _add_packet(self, message: str) -> None:
        ledger = self._ledger
        handled = None if ledger is None else ledger.handed_over(self._event_loop.current_time)
        if handled is None:
            self._add("handle_packet", message)
        else:
            self._add("handle_packet", message, lambda: handled(self._event_loop.current_time))

    def _add_telemetry(self, telemetry: Any) -> None:
        """Add telemetry, or let it take the place of the one that waits."""
        events = iter(self._events)
        next(events, None)
        waiting = next((event for event in events if event.callback == "handle_telemetry"), None)
        if waiting is None:
            self._add("handle_telemetry", telemetry)
        else:
            waiting.argument = telemetry

    def _cancel_timer(self, timer: str) -> None:
        self._cancel(timer)
        for event in self._events:
            if event.callback == "handle_timer" and event.argument == timer:
                event.callback = ""

    def _begin_next(self) -> None:
        events = self._events
        while events and not events[0].callback:
            events.popleft()
        if events:
            end = time_after(self._event_loop.current_time, self._time.draw_s(self._stream))
            self._event_loop.schedule_event(end, self._processed, context_of(self._node, events[0].callback))

    def _processed(self) -> None:
        event = self._events[0]
        call = self._callbacks[event.callback]
        event.callback = ""  # it keeps its place, so that others wait meanwhile
        if event.handled is not None:
            event.handled()
        call(event.argument)
        self._begin_next()


class ComputerHandler(INodeHandler):
    """Lets events of protocols wait until the computer of their node has processed them.

    A timer, a message or telemetry begins to be processed when the events before it have been, and the
    protocol gets it when the processing time has passed. A canceled timer does not reach the protocol. Of
    telemetry, only the latest waits, as with a driver that keeps the last value. The start and the end of a
    run take no time.
    """

    def __init__(self, times: dict[int, ProcessingTime], ledger: DeliveryLedger | None = None) -> None:
        """`times` are those of the nodes that have a computer, by id. `ledger` counts delays of messages."""
        self._times = times
        self._ledger = ledger
        self._event_loop: EventLoop | None = None

    @staticmethod
    def get_label() -> str:
        """Return "computer"."""
        return "computer"

    def inject(self, event_loop: EventLoop) -> None:
        """Take the event loop of a new simulation."""
        self._event_loop = event_loop

    def register_node(self, node: Node[Any]) -> None:
        """Do nothing: see `prepare`."""

    def prepare(self, node: Node[Any]) -> None:
        """Give a node its computer, if it has one, before its protocol is made."""
        time = self._times.get(node.id)
        if time is not None:
            assert self._event_loop is not None
            _Computer(node, time, self._event_loop, self._ledger)
