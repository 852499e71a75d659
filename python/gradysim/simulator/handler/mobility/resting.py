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

    def _schedule_update(self, event_loop: EventLoop) -> None:
        if self._updates != 0:  # The first update is scheduled when nobody is there yet.
            self._updates = self._next_to_make(event_loop) - 1
        super()._schedule_update(event_loop)

    def _next_to_make(self, event_loop: EventLoop) -> int:
        following = self._updates + 1
        latest = min((group.due for group in self._telemetry.values()), default=following + _MOST_LEFT_OUT)
        if latest <= following or self._is_anybody_flying():
            return following
        latest = min(latest, following + _MOST_LEFT_OUT)
        next_time = event_loop.next_time()
        if next_time is None:
            return latest
        return self._times.last_before(next_time, range(following, latest + 1))

    def _is_anybody_flying(self) -> bool:
        nodes = self.nodes
        return any(nodes[node_id].position != target for node_id, target in self.targets.items())
