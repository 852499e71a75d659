"""Timers of the nodes."""

from functools import partial
from typing import Any

from gradysim.encapsulator.validation import wrong_timer, wrong_timer_name
from gradysim.protocol.errors import TimerException as TimerException
from gradysim.protocol.plain_value import readable_number
from gradysim.simulator.event import (
    MOST_AT_ONE_INSTANT,
    EventLoop,
    EventLoopException,
    InstantCount,
    ScheduledEvent,
)
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.log import context_of
from gradysim.simulator.node import Node

# Pending timers of one node: name -> serial number -> (time, event).
_Pending = dict[str, dict[int, tuple[float, ScheduledEvent]]]


class TimerHandler(INodeHandler):
    """Calls `handle_timer` of a node when a timer is due. Equal times run in the order of setting."""

    def __init__(self) -> None:
        self._event_loop: EventLoop | None = None
        self._pending: dict[int, _Pending] = {}
        self._contexts: dict[int, str] = {}
        self._for_now: dict[int, InstantCount] = {}
        self._serial = 0

    @staticmethod
    def get_label() -> str:
        """Return "timer"."""
        return "timer"

    def inject(self, event_loop: EventLoop) -> None:
        """Take the event loop of a new simulation."""
        if self._event_loop is not None:
            self._pending = {}
            self._contexts = {}
            self._for_now = {}
        self._event_loop = event_loop

    def register_node(self, node: Node[Any]) -> None:
        """Let the node have timers."""
        self._pending[node.id] = {}
        self._contexts[node.id] = context_of(node, "handle_timer")

    def get_current_time(self) -> float:
        """Return the simulated time in seconds; 0 before the first simulation."""
        return 0.0 if self._event_loop is None else self._event_loop.current_time

    def set_timer(self, message: str, timestamp: float, node: Node[Any]) -> None:
        """Call `handle_timer(message)` of a node at `timestamp`, an absolute simulated time in seconds.

        Several timers of one name may be pending. Raise TimerException if the node is not registered, the
        name is not a str, the time is in the past or not finite, or the node has set a million timers for the
        current time.
        """
        pending = self._timers_of(node)
        if not isinstance(message, str):
            raise TimerException(wrong_timer_name(message))
        if self._event_loop is None:
            raise TimerException("timers can be set only in a simulation: inject an event loop first")
        if timestamp == self._event_loop.crowded_instant:
            count = self._for_now.setdefault(node.id, InstantCount())
            if count.exceeds(timestamp):
                raise TimerException(
                    f"node {node.id} has set {MOST_AT_ONE_INSTANT} timers for now, "
                    f"{readable_number(timestamp)} s, and this one, {message!r}, is one more: time stands "
                    "still; expected a later time (timers take absolute simulated time: current_time() + 1, "
                    "not 1)"
                )
        self._serial = serial = self._serial + 1
        try:
            event = self._event_loop.schedule_event(
                timestamp, partial(self.fire_timer, message, node, serial), self._contexts[node.id]
            )
        except EventLoopException as error:
            wrong = wrong_timer(message, timestamp, node.id, self._event_loop.current_time)
            raise TimerException(wrong or str(error)) from None
        pending.setdefault(message, {})[serial] = (timestamp, event)

    def cancel_timer(self, message: str, node: Node[Any]) -> None:
        """Remove every pending timer of that name; no-op if there is none.

        Raise TimerException if the node is not registered, or the name is not a str.
        """
        pending = self._timers_of(node)
        if not isinstance(message, str):
            raise TimerException(wrong_timer_name(message))
        timers = pending.pop(message, None)
        if timers is not None and self._event_loop is not None:
            for timestamp, event in timers.values():
                self._event_loop.cancel_event(timestamp, event)

    def fire_timer(self, message: str, node: Node[Any], identifier: int) -> None:
        """Call the node: the timer with that serial number is due, and no longer pending."""
        pending = self._pending[node.id]
        timers = pending[message]
        del timers[identifier]
        if not timers:
            del pending[message]
        node.protocol_encapsulator.handle_timer(message)

    def _timers_of(self, node: Node[Any]) -> _Pending:
        try:
            return self._pending[node.id]
        except KeyError:
            raise TimerException(f"node {node.id} is not registered with the timer handler") from None
