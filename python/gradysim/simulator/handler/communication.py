"""The ideal network of prototype mode: every node in range gets a message, after a fixed delay."""

import logging
import random
from collections import Counter, defaultdict
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeAlias, cast

from gradysim.encapsulator.random_stream import Purpose, RandomStream
from gradysim.encapsulator.validation import addressed_by_id, checked_interface, wrong_communication
from gradysim.protocol.checked_values import checked_number
from gradysim.protocol.defaults import TRANSMISSION_RANGE_M
from gradysim.protocol.errors import CommunicationException as CommunicationException
from gradysim.protocol.messages.communication import CommunicationCommand, CommunicationCommandType
from gradysim.protocol.plain_value import readable_number
from gradysim.protocol.position import Position, squared_distance
from gradysim.simulator.event import MOST_AT_ONE_INSTANT, Callback, EventLoop, InstantCount, ScheduledEvent
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.log import context_of
from gradysim.simulator.node import Node
from gradysim.simulator.validation import checked_configuration

_logger = logging.getLogger(__name__)

_US_PER_S = 1e6

KINDS = {CommunicationCommandType.BROADCAST: "broadcast", CommunicationCommandType.SEND: "unicast"}


class _Arrivals:
    """Deliveries of one kind of message with the same delay.

    Attributes:
        count: All of them.
        waiting: Those of which the receiver's computer has not processed the message.
        waits: The others that waited for a computer, by the time from arrival to handling; us, rounded.
    """

    def __init__(self) -> None:
        self.count = 0
        self.waiting = 0
        self.waits: Counter[int] = Counter()

    def deliver(self, receive: Callback) -> None:
        self.count += 1
        receive()

    def handled(self, arrived_s: float, now_s: float) -> None:
        self.waiting -= 1
        self.waits[round((now_s - arrived_s) * _US_PER_S)] += 1

    def by_delay(self, delay_s: float) -> Iterator[tuple[float, int]]:
        yield delay_s, self.count - self.waiting - self.waits.total()
        yield from ((delay_s + wait_us / _US_PER_S, count) for wait_us, count in self.waits.items())


def _sums(delivered: Mapping[float, _Arrivals]) -> dict[float, int]:
    sums: Counter[float] = Counter()
    for delay_s, arrivals in delivered.items():
        for total_s, count in arrivals.by_delay(delay_s):
            sums[total_s] += count
    return dict(sums)


class _Counts:
    """Counts of one kind of message and its deliveries."""

    def __init__(self) -> None:
        self.sent = self.carried = self.out_of_range = self.lost = 0
        self.delivered: dict[float, _Arrivals] = defaultdict(_Arrivals)  # by their delays; s


class DeliveryLedger:
    """Counts messages and their deliveries, one per receiver, in one simulation at a time."""

    def __init__(self, *, has_computers: bool = False) -> None:
        """Count from 0. With `has_computers`, messages may wait at their receivers: see `handed_over`."""
        self._has_computers = has_computers
        self.clear()

    def clear(self) -> None:
        """Set all counts to 0."""
        self._counts = {kind: _Counts() for kind in KINDS}
        self._arriving: _Arrivals | None = None

    def note(
        self,
        kind: CommunicationCommandType,
        copies: Iterable[ScheduledEvent],
        *,
        lost: int,
        out_of_range: int,
        delay_s: float,
    ) -> list[ScheduledEvent]:
        """Count a message, and return its delivery events so that they count themselves when they run."""
        counts = self._counts[kind]
        arrivals = counts.delivered[delay_s]
        deliver = partial(self._deliver, arrivals) if self._has_computers else arrivals.deliver
        counted: list[ScheduledEvent] = [(partial(deliver, receive), context) for receive, context in copies]
        counts.sent += 1
        counts.carried += len(counted)
        counts.lost += lost
        counts.out_of_range += out_of_range
        return counted

    def _deliver(self, arrivals: _Arrivals, receive: Callback) -> None:
        self._arriving = arrivals
        arrivals.deliver(receive)
        self._arriving = None

    def handed_over(self, now_s: float) -> Callable[[float], None] | None:
        """Note that the message under way waits for a computer. None if no message is being delivered.

        The returned function takes the time at which the protocol gets it, in seconds.
        """
        arrivals = self._arriving
        if arrivals is None:
            return None
        arrivals.waiting += 1
        return partial(arrivals.handled, now_s)

    def message_outcomes(self) -> dict[str, dict[str, int]]:
        """Return the outcomes of the messages so far: {kind: {outcome: count}}.

        A broadcast is "sent". A message to one node that arrived is "acknowledged", since nothing keeps an
        acknowledgement from the sender.
        """
        unicast = self._outcomes(CommunicationCommandType.SEND, "acknowledged", "out_of_range")
        return {
            "broadcast": {"sent": self._counts[CommunicationCommandType.BROADCAST].sent},
            "unicast": unicast,
        }

    def delays(self) -> dict[str, dict[float, int]]:
        """Return the delays of the deliveries so far: {kind: {delay in s: count}}."""
        return {name: _sums(self._counts[kind].delivered) for kind, name in KINDS.items()}

    def frame_outcomes(self) -> dict[str, dict[str, int]]:
        """Return the outcomes of the deliveries so far: {kind: {outcome: count}}.

        "below_sensitivity" (beyond the range) and "lost" (by the medium's failure rate) are decided at
        sending. "in_air" is not delivered yet; at the end of the run, it is never delivered.
        """
        return {name: self._outcomes(kind, "delivered", "below_sensitivity") for kind, name in KINDS.items()}

    def _outcomes(self, kind: CommunicationCommandType, arrived: str, beyond: str) -> dict[str, int]:
        counts = self._counts[kind]
        delivered = sum(arrivals.count for arrivals in counts.delivered.values())
        return {
            arrived: delivered,
            beyond: counts.out_of_range,
            "lost": counts.lost,
            "in_air": counts.carried - delivered,
        }


@dataclass
class CommunicationMedium:
    """What the network does to messages.

    Attributes:
        transmission_range: Receivers at this distance or less get the message; m, >= 0.
        delay: From sending to reception; s, >= 0.
        failure_rate: Probability that a receiver in range misses the message, independent of others; 0 to 1.
    """

    transmission_range: float = TRANSMISSION_RANGE_M
    delay: float = 0
    failure_rate: float = 0

    def __post_init__(self) -> None:
        checked_number("transmission_range", self.transmission_range, 0, infinite=True, unit="m")
        checked_number("delay", self.delay, 0, unit="s")
        checked_number("failure_rate", self.failure_rate, 0, 1)


def can_transmit(
    source_position: Position,
    destination_position: Position,
    medium: CommunicationMedium,
    stream: random.Random | None = None,
) -> bool:
    """Return whether a message gets from one point (m) to another. A failure is drawn from `stream`.

    Without a stream, Python's global one is used.
    """
    reach = medium.transmission_range
    if squared_distance(source_position, destination_position) > reach * reach:
        return False
    if medium.failure_rate <= 0:
        return True
    return (stream or random).random() >= medium.failure_rate


class CommunicationSource:
    """A node that sends messages."""

    def __init__(self, node: Node[Any]) -> None:
        self.node = node
        self._without_delay = InstantCount()

    def hand_over_message(self, message: str, endpoint: "CommunicationDestination") -> None:
        """Log that a message is sent to the endpoint. This does not deliver it."""
        _logger.debug("%s sends to %s: %s", self.node.id, endpoint.node.id, message)

    def count_at(self, now: float, medium: CommunicationMedium) -> None:
        """Count a message without delay. CommunicationException if there are too many at one instant."""
        if self._without_delay.exceeds(now):
            raise CommunicationException(
                f"node {self.node.id} has sent {MOST_AT_ONE_INSTANT} messages at {readable_number(now)} s, "
                f"with a delay of {medium.delay} s: time stands still; expected a delay, or answers that end"
            )


class CommunicationDestination:
    """A node that receives messages."""

    def __init__(self, node: Node[Any]) -> None:
        self.node = node
        self.context = context_of(node, "handle_packet")
        # Each receiver draws its own losses, so that they do not depend on other receivers.
        self.stream = RandomStream(getattr(node, "seed", 0), node.id, Purpose.COMMUNICATION)

    def receive_message(self, message: str, source: CommunicationSource) -> None:
        """Hand the message to the node's protocol, without the sender."""
        self.node.protocol_encapsulator.handle_packet(message)


MessageObserver: TypeAlias = Callable[[int, CommunicationCommand, list[int], list[int], int, float], None]
"""Takes the id of the sender, its command, the ids of the receivers, the ids of those whose reception fails
by the failure rate, the number of nodes out of range, and the delay in s."""


class CommunicationHandler(INodeHandler):
    """Carries messages between nodes. Positions count at the instant of sending.

    Attributes:
        default_medium: Medium of commands without a medium of their own.
        medium_of: Media of nodes that have another one, by id.
        on_message: Called for each message, for a replay; None to disable it.
    """

    def __init__(
        self, communication_medium: CommunicationMedium | None = None, ledger: DeliveryLedger | None = None
    ) -> None:
        """Carry messages over a medium, by default `CommunicationMedium()`.

        `ledger` counts messages and deliveries; None for no counts.
        """
        self._ledger = ledger
        self.on_message: MessageObserver | None = None
        self.default_medium = checked_configuration(communication_medium, CommunicationMedium)
        self.medium_of: dict[int, CommunicationMedium] = {}
        self._event_loop: EventLoop | None = None
        self._sources: dict[int, CommunicationSource] = {}
        self._destinations: dict[int, CommunicationDestination] = {}
        overridden = type(self)._transmit_message is not CommunicationHandler._transmit_message
        self._transmits_one_by_one = overridden

    @staticmethod
    def get_label() -> str:
        """Return "communication"."""
        return "communication"

    def inject(self, event_loop: EventLoop) -> None:
        """Take the event loop of a new simulation."""
        if self._ledger is not None:
            self._ledger.clear()
        self._event_loop = event_loop
        self._sources = {}
        self._destinations = {}

    def register_node(self, node: Node[Any]) -> None:
        """Let the node send and receive. CommunicationException if the event loop is missing."""
        if self._event_loop is None:
            raise CommunicationException(f"cannot register node {node.id}: inject an event loop first")
        self._sources[node.id] = CommunicationSource(node)
        self._destinations[node.id] = CommunicationDestination(node)

    def handle_command(
        self,
        command: CommunicationCommand,
        sender: Node[Any],
        medium: CommunicationMedium | None = None,
    ) -> None:
        """Send a message over `medium`, by default the sender's.

        Raises:
            CommunicationException: The sender is not registered, the command is not valid, or the node has
                sent a million messages without delay at this instant.
        """
        event_loop = self._event_loop
        if event_loop is None or sender.id not in self._destinations:
            raise CommunicationException(f"node {sender.id} is not registered with the communication handler")
        message, kind = getattr(command, "message", None), getattr(command, "command_type", None)
        # A user's own command may have neither.
        address, interface = getattr(command, "destination", None), getattr(command, "interface", 0)
        if not isinstance(message, str):
            raise self._refusal(command, sender)
        if type(interface) is not int or interface:
            checked_interface(interface)  # all interfaces share one medium
        if isinstance(address, str):
            command = addressed_by_id(command, getattr(sender, "ids_by_name", {}))
            address = command.destination
        destinations: Collection[CommunicationDestination]
        if kind == CommunicationCommandType.BROADCAST:
            destinations = self._destinations.values()
        elif kind == CommunicationCommandType.SEND:
            destinations = (self._destination_of(address, command, sender),)
        else:
            raise self._refusal(command, sender)
        _logger.debug("%s sends to %s: %s", sender.id, address, message)
        medium = medium or self.medium_of.get(sender.id, self.default_medium)
        source = self._sources[sender.id]
        if self._transmits_one_by_one:
            for destination in destinations:
                if destination.node is not source.node:
                    self._transmit_message(message, source, destination, medium)
            return
        copies, lost_at = _copies(message, source, destinations, medium)
        addressed = len(destinations) - (kind == CommunicationCommandType.BROADCAST)
        lost = len(lost_at)
        out_of_range = addressed - len(copies) - lost
        if self.on_message is not None:
            receivers = [receiver_of(copy) for copy in copies]
            self.on_message(sender.id, command, receivers, lost_at, out_of_range, medium.delay)
        if self._ledger is not None:
            copies = self._ledger.note(
                kind, copies, lost=lost, out_of_range=out_of_range, delay_s=medium.delay
            )
        _schedule(copies, source, medium, event_loop)

    def _transmit_message(
        self,
        message: str,
        source: CommunicationSource,
        destination: CommunicationDestination,
        medium: CommunicationMedium,
    ) -> None:
        """Send a message to one destination.

        A subclass may override it to change the medium or to drop the message. It is then called for each
        destination. Otherwise all deliveries are scheduled at once, which is faster, and only these are
        counted.
        """
        assert self._event_loop is not None
        copies, _ = _copies(message, source, (destination,), medium)
        _schedule(copies, source, medium, self._event_loop)

    def _destination_of(
        self, address: Any, command: CommunicationCommand, sender: Node[Any]
    ) -> CommunicationDestination:
        try:
            destination = self._destinations.get(address)
        except TypeError:  # not hashable, such as a list
            destination = None
        if destination is None or destination.node is sender:
            raise self._refusal(command, sender)
        return destination

    def _refusal(self, command: CommunicationCommand, sender: Node[Any]) -> CommunicationException:
        return CommunicationException(wrong_communication(command, sender.id, self._destinations.keys()))


def _schedule(
    copies: list[ScheduledEvent],
    source: CommunicationSource,
    medium: CommunicationMedium,
    event_loop: EventLoop,
) -> None:
    """Schedule the deliveries of a message after the delay of the medium."""
    if copies:
        arrival = event_loop.current_time + medium.delay
        if arrival == event_loop.crowded_instant:
            source.count_at(arrival, medium)
        event_loop.schedule_events(arrival, copies)


def receiver_of(delivery: ScheduledEvent) -> int:
    """Return the id of the node to which an event of `_copies` delivers a message."""
    receive = cast("partial[None]", delivery[0]).func
    return cast("CommunicationDestination", receive.__self__).node.id  # type: ignore[attr-defined]


def _copies(
    message: str,
    source: CommunicationSource,
    destinations: Collection[CommunicationDestination],
    medium: CommunicationMedium,
) -> tuple[list[ScheduledEvent], list[int]]:
    """Return a delivery event for each destination that the message reaches, and the ids of others in range.

    This is `can_transmit`, inlined for speed.
    """
    reach_squared = medium.transmission_range * medium.transmission_range
    failure_rate = medium.failure_rate
    sender = source.node
    x, y, z = sender.position
    copies: list[ScheduledEvent] = []
    lost: list[int] = []
    for destination in destinations:
        node = destination.node
        if node is sender:
            continue
        other_x, other_y, other_z = node.position
        dx = other_x - x
        dy = other_y - y
        dz = other_z - z
        if dx * dx + dy * dy + dz * dz > reach_squared:
            continue
        if failure_rate > 0 and destination.stream.random() < failure_rate:
            lost.append(node.id)
            continue
        copies.append((partial(destination.receive_message, message, source), destination.context))
    return copies, lost
