"""Massless vehicles whose updates are left out as long as nothing comes of them."""

from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.mobility.massless import MasslessMobilityHandler

# So many updates may be left out at once: time goes on step by step even if nothing happens ever after.
_MOST_LEFT_OUT = 1 << 20


class RestingMobilityHandler(MasslessMobilityHandler):
    """Skips the updates at which no vehicle moves and nobody is told its place.

    The last update before each other event is made in any case. By it the one after is scheduled as ever, the
    first to which that event could give something to do: at the same time, and at the same place among the
    events of that time. So nothing differs but the number of events, given that all that happens, happens in
    events: who counts them, or lets others act between them, takes a `MasslessMobilityHandler`.
    """

    _on_their_way = True

    def _move(self) -> bool:
        self._on_their_way = super()._move()
        return self._on_their_way

    def _schedule_update(self, event_loop: EventLoop) -> None:
        # The first update is scheduled when nobody is there yet. Most often somebody is told each one.
        if self._updates != 0 and not self._on_their_way and 1.0 not in self._telemetry:
            self._updates = self._next_to_make(event_loop) - 1
        super()._schedule_update(event_loop)

    def _next_to_make(self, event_loop: EventLoop) -> int:
        following = self._updates + 1
        latest = following + _MOST_LEFT_OUT
        for group in self._telemetry.values():
            latest = min(latest, group.due)
        next_time = event_loop.next_time()
        if next_time is None:
            return latest
        return self._times.last_before(next_time, range(following, latest + 1))
