"""The clock of a simulation: pending events by time. Events of equal time run in the order of scheduling.

Events of one instant share a list, and only the instants are in a heap. Telemetry of all nodes and the
receptions of a broadcast come in such groups. Each of these events costs an append instead of a sift.
"""

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from heapq import heappop, heappush
from typing import Any

Callback = Callable[[], Any]

ScheduledEvent = tuple[Callback, str]
"""What the loop stores of an event: its callback and its context."""

# Largest number of past events in the list of the current instant before they are dropped.
_RAN_AT_MOST = 1 << 16


class EventLoopException(Exception):  # noqa: N818 (the published name)
    """An event that cannot be scheduled, or a request to an empty loop."""


@dataclass(slots=True)
class Event:
    """An event taken from the loop. Events are ordered by time.

    Attributes:
        timestamp: Simulated time in seconds.
        callback: Called at that time.
        context: Description for the log.
    """

    timestamp: float
    callback: Callback
    context: str

    def __lt__(self, other: "Event") -> bool:
        return self.timestamp < other.timestamp


class EventLoop:
    """Pending events, and the time of the event taken last.

    Attributes:
        crowded_instant: The latest simulated time, in seconds, at which tens of thousands of events ran; NaN
            before the first. Code that schedules another event for it can check whether time stands still.
    """

    def __init__(self) -> None:
        self.crowded_instant = math.nan
        self._current_time = 0.0
        # One list of events per instant; `_instants` is a heap of its keys without the current instant.
        self._events: dict[float, list[ScheduledEvent]] = {}
        self._instants: list[float] = []
        # The list of the current instant, and the number of events taken from it; None when it is used up.
        self._current: list[ScheduledEvent] | None = None
        self._taken = 0
        # Number of events in the lists, including those taken from the current one.
        self._held = 0

    @property
    def current_time(self) -> float:
        """Simulated time in seconds: the time of the event taken last, 0 before the first."""
        return self._current_time

    def __len__(self) -> int:
        return self._held if self._current is None else self._held - self._taken

    def schedule_event(self, timestamp: float, callback: Callback, context: str = "") -> ScheduledEvent:
        """Call `callback()` at `timestamp`, after all events scheduled for that time so far.

        Args:
            timestamp: Absolute simulated time in seconds, finite, not before `current_time`.
            callback: Takes no arguments.
            context: Description of the event for the log.

        Returns:
            The event, for `cancel_event`.

        Raises:
            EventLoopException: The time is in the past or not finite, or the callback cannot be called.
        """
        if not callable(callback):
            raise EventLoopException(f"an event's callback must be callable, got {callback!r}")
        event = (callback, context)
        try:
            events = self._events.get(timestamp)
        except TypeError:  # not hashable, such as a list
            events = None
        if events is None:
            events = self._open(timestamp)
        events.append(event)
        self._held += 1
        return event

    def schedule_events(self, timestamp: float, events: Iterable[ScheduledEvent]) -> None:
        """Schedule several events for one time, in the given order; see `schedule_event`."""
        pending = self._events.get(timestamp)
        if pending is None:
            pending = self._open(timestamp)
        before = len(pending)
        pending.extend(events)
        self._held += len(pending) - before

    def cancel_event(self, timestamp: float, event: ScheduledEvent) -> bool:
        """Remove an event that `schedule_event` returned for that time. Return whether it was pending."""
        events = self._events.get(float(timestamp))
        if events is not None:
            for index in range(self._taken if events is self._current else 0, len(events)):
                if events[index] is event:
                    del events[index]
                    self._held -= 1
                    return True
        return False

    def take_events(self, until: float = math.inf) -> Iterator[ScheduledEvent]:
        """Remove events one by one as they are requested, and set the clock to the time of each.

        Events scheduled or canceled in the meantime count. Stops before the first event after `until` (s).
        """
        while True:
            current = self._current
            taken = self._taken
            if current is None or taken >= len(current):
                current = self._turn_to_next(until)
                if current is None:
                    return
                taken = 0
            elif taken == _RAN_AT_MOST:
                self._drop_those_that_ran(current)
                taken = 0
            self._taken = taken + 1
            yield current[taken]

    def take_event(self, until: float = math.inf) -> ScheduledEvent | None:
        """Remove the next event and set the clock to its time; None if there is none up to `until`.

        Same as the first item of `take_events`, and faster for a single event.
        """
        current = self._current
        taken = self._taken
        if current is None or taken >= len(current):
            current = self._turn_to_next(until)
            if current is None:
                return None
            taken = 0
        elif taken == _RAN_AT_MOST:
            self._drop_those_that_ran(current)
            taken = 0
        self._taken = taken + 1
        return current[taken]

    def pop_event(self) -> Event:
        """Remove the next event and set the clock to its time. EventLoopException if no event is pending."""
        event = self.take_event()
        if event is None:
            raise EventLoopException("there is no pending event to pop")
        return Event(self._current_time, *event)

    def peek_event(self) -> Event | None:
        """Return the next event without removing it; None if there is none."""
        instant = self.next_time()
        if instant is None:
            return None
        events = self._events[instant]
        return Event(instant, *events[self._taken if events is self._current else 0])

    def next_time(self) -> float | None:
        """Return the time of the next event in seconds; None if there is none."""
        if self._current is not None and self._taken < len(self._current):
            return self._current_time
        return self._next_instant()

    def advance_to(self, timestamp: float) -> None:
        """Set the clock forward to a time without events.

        Raise EventLoopException if the time is in the past, or an event is pending before it.
        """
        following = self.next_time()
        if not self._current_time <= timestamp < math.inf or (
            following is not None and following < timestamp
        ):
            raise EventLoopException(
                f"cannot set the clock to {timestamp!r} s: it is {self._current_time} s "
                f"and the next event is at {following} s"
            )
        if timestamp > self._current_time:
            self._close_current()
            self._current_time = float(timestamp)

    def clear(self) -> None:
        """Remove every pending event. The clock does not change."""
        self._events.clear()
        self._instants.clear()
        self._current = None
        self._held = 0

    def _open(self, timestamp: float) -> list[ScheduledEvent]:
        """Return the event list of an instant that has no key in `_events`; usually a new list."""
        try:
            valid = self._current_time <= timestamp < math.inf
            instant = float(timestamp)
        except (TypeError, ValueError, OverflowError):
            valid, instant = False, math.nan
        if not valid:
            raise EventLoopException(
                f"cannot schedule an event at {timestamp!r}: expected a finite number of seconds, "
                f"at or after the current time, {self._current_time} s"
            )
        events = self._events.get(instant)  # a Fraction becomes a float, which need not equal it
        if events is None:
            events = self._events[instant] = []
            heappush(self._instants, instant)
        return events

    def _turn_to_next(self, until: float) -> list[ScheduledEvent] | None:
        """Advance to the next instant with events.

        None if it is after `until`. The current one is used up.
        """
        instant = self._next_instant()
        if instant is None or instant > until:
            return None
        heappop(self._instants)
        self._current_time = instant
        self._current = self._events[instant]
        return self._current

    def _drop_those_that_ran(self, current: list[ScheduledEvent]) -> None:
        """Limit the length of the list of the current instant."""
        del current[:_RAN_AT_MOST]
        self._held -= _RAN_AT_MOST
        self.crowded_instant = self._current_time

    def _close_current(self) -> None:
        if self._current is not None:
            del self._events[self._current_time]
            self._current = None
            self._held -= self._taken

    def _next_instant(self) -> float | None:
        """Find the next instant with events. The current one is used up."""
        self._close_current()
        instants = self._instants
        while instants:
            if self._events[instants[0]]:
                return instants[0]
            # All its events were canceled.
            del self._events[heappop(instants)]
        return None


def time_after(now_s: float, delay_s: float) -> float:
    """Return the time `delay_s` after `now_s`, in seconds: an integer of picoseconds, as in the engine."""
    ps_per_s = 1e12
    return max((round(now_s * ps_per_s) + round(delay_s * ps_per_s)) / ps_per_s, now_s)


MOST_AT_ONE_INSTANT = 1_000_000
"""Limit of timers, or of messages, of one node at one instant. The engine has the same limit. Floods stay far
below it: if each of a thousand nodes floods one message, each node sends a thousand."""


class InstantCount:
    """Counts the actions of one node at the current instant."""

    __slots__ = ("_count", "_instant")

    def __init__(self) -> None:
        self._instant = -math.inf
        self._count = 0

    def exceeds(self, now: float) -> bool:
        """Count one more at `now` (s). Return whether the count exceeds `MOST_AT_ONE_INSTANT`."""
        if now != self._instant:
            self._instant = now
            self._count = 0
        self._count += 1
        return self._count > MOST_AT_ONE_INSTANT
