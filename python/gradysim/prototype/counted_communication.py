"""Prototype mode's network, with a ledger of what became of each copy of each message.

A broadcast makes one copy for every other node, a message to one node one copy.
"""

from collections import deque
from typing import Any, NamedTuple

from gradysim.protocol.messages.communication import CommunicationCommand, CommunicationCommandType
from gradysim.protocol.position import squared_distance
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.communication import CommunicationHandler, CommunicationMedium
from gradysim.simulator.node import Node

FATES = ("delivered", "out_of_range", "lost", "in_air")
KINDS = ("broadcast", "unicast")


class _Flight(NamedTuple):
    arrival_s: float
    kind: str
    copies: int


class CountedCommunication(CommunicationHandler):
    """Carries messages as its base does, and counts them."""

    def inject(self, event_loop: EventLoop) -> None:
        """Take the event loop of a new simulation; the ledger starts anew."""
        super().inject(event_loop)
        self._loop = event_loop
        self._nodes: dict[int, Node[Any]] = {}
        self._sent = dict.fromkeys(KINDS, 0)
        self._copies = {kind: dict.fromkeys(FATES, 0) for kind in KINDS}
        self._flights: deque[_Flight] = deque()

    def register_node(self, node: Node[Any]) -> None:
        """Let the node send and receive."""
        super().register_node(node)
        self._nodes[node.id] = node

    def handle_command(
        self,
        command: CommunicationCommand,
        sender: Node[Any],
        medium: CommunicationMedium | None = None,
    ) -> None:
        """Send a message and count its copies; the arguments and errors are those of the base."""
        pending = len(self._loop)
        super().handle_command(command, sender, medium)
        carried = len(self._loop) - pending
        medium = medium or self.default_medium
        if command.command_type == CommunicationCommandType.BROADCAST:
            kind, receivers = "broadcast", list(self._nodes.values())
            copies = len(receivers) - 1
        else:
            assert command.destination is not None
            kind, receivers = "unicast", [self._nodes[command.destination]]
            copies = 1
        lost = in_range(sender, receivers, medium) - carried if medium.failure_rate > 0 else 0
        counts = self._copies[kind]
        counts["delivered"] += carried
        counts["lost"] += lost
        counts["out_of_range"] += copies - carried - lost
        self._sent[kind] += 1
        if medium.delay > 0 and carried:
            self._note_flight(_Flight(self._loop.current_time + medium.delay, kind, carried))

    def message_fates(self) -> dict[str, dict[str, int]]:
        """Return how many messages were sent: {kind: {"sent": count}}."""
        return {kind: {"sent": count} for kind, count in self._sent.items()}

    def copy_fates(self) -> dict[str, dict[str, int]]:
        """Return what became of the copies until now: {kind: {fate: count}}; the sum is all there were.

        "out_of_range" and "lost" (by the medium's failure rate) are decided when a message is sent; "in_air"
        has not arrived yet.
        """
        fates = {kind: dict(counts) for kind, counts in self._copies.items()}
        for flight in self._flights:
            if flight.arrival_s > self._loop.current_time:
                fates[flight.kind]["delivered"] -= flight.copies
                fates[flight.kind]["in_air"] += flight.copies
        return fates

    def _note_flight(self, flight: _Flight) -> None:
        flights = self._flights
        while flights and flights[0].arrival_s <= self._loop.current_time:
            flights.popleft()
        flights.append(flight)


def in_range(sender: Node[Any], receivers: list[Node[Any]], medium: CommunicationMedium) -> int:
    """Return how many of `receivers`, without the sender, are in the range of `medium` (inclusive)."""
    reach = medium.transmission_range * medium.transmission_range
    return sum(
        squared_distance(sender.position, receiver.position) <= reach
        for receiver in receivers
        if receiver is not sender
    )
