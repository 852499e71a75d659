"""How UAVs pair in the showcases ZigZag and DADCA: heartbeat, request, confirmation, exchange of data.

A UAV broadcasts heartbeats. One that hears such a heartbeat, and that will meet the sender, requests a
pairing. Both then confirm until one confirmation has arrived at each of them.
"""

from dataclasses import astuple, dataclass
from enum import Enum, IntEnum
from typing import Annotated, ClassVar

from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.showcases.mission import FlyingProtocol


class Kind(IntEnum):
    """What a message is."""

    HEARTBEAT = 0
    REQUEST = 1
    CONFIRMATION = 2
    DATA = 3


@dataclass(frozen=True)
class Message:
    """A message of these protocols.

    Attributes:
        kind: What it is.
        sender: Id of the sender.
        to: Id of the node that it is for; -1 for all.
        following: Waypoint that the sender flies to; -1 if it does not have a mission.
        last: Waypoint that the sender comes from; -1 if there is none.
        is_reversed: 1 if the sender flies towards the first waypoint.
        data: Packets that the sender carries.
        left: UAVs before the sender along the mission, as far as it knows (DADCA).
        right: UAVs behind it.
    """

    kind: int
    sender: int
    to: int = -1
    following: int = -1
    last: int = -1
    is_reversed: int = 0
    data: int = 5
    left: int = 0
    right: int = 0

    @property
    def is_from_ground(self) -> bool:
        """Whether the sender does not have a mission."""
        return self.following == -1

    @property
    def is_heartbeat_of_uav(self) -> bool:
        """Whether it is the heartbeat of a node with a mission."""
        return self.kind == Kind.HEARTBEAT and not self.is_from_ground

    def encoded(self, length: int) -> str:
        """Return the message as a string of at least that many characters."""
        return " ".join(map(str, astuple(self))).removesuffix(" 0 0").ljust(length)

    @classmethod
    def decoded(cls, text: str) -> "Message | None":
        """Return the message of a string; None if it is not one."""
        try:
            return cls(*map(int, text.split()))
        except (ValueError, TypeError):
            return None


class State(Enum):
    """Progress of a pairing."""

    FREE = "free"
    REQUESTING = "requesting"
    PAIRED = "paired"
    DONE = "done"
    COLLECTING = "collecting"


class PairingProtocol(FlyingProtocol):
    """Pairs with UAVs and the ground station. Subclasses say what a pair exchanges, and how it parts.

    Tracked variables:
        data_load: Packets that the node carries.
    """

    length: ClassVar[int] = 0
    """Fewest characters of a message: as many bytes as one has in the OMNeT++ project."""

    timeout_duration: Annotated[float, "s"] = 3.0
    """Time after the start of a pairing in which other nodes are ignored."""

    def initialize(self) -> None:
        """Start without data, and free."""
        super().initialize()
        self._load = self._stable_load = 0
        self._state = State.FREE
        self._peer = self._last_peer = -1
        self._is_waiting = False
        self._course = self._flight.course
        self._track_load(0)
        self._announce()

    def handle_timer(self, timer: str) -> None:
        """End a pairing that has taken too long, or do what the base does."""
        if timer == "timeout":
            self._become_free()
        else:
            super().handle_timer(timer)

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        """Fly on. During a pairing the course in messages stays the same."""
        before = self._flight.course
        super().handle_telemetry(telemetry)
        if self._flight.course != before:
            self._announce()

    def handle_packet(self, message: str) -> None:
        """Take part in a pairing, or take the data of a sensor."""
        received = Message.decoded(message)
        if received is None or self._ignores(received.sender):
            return
        if received.kind == Kind.DATA:
            self._collect(received)
        elif received.is_from_ground or not self._flight.is_on_detour:
            if received.kind == Kind.HEARTBEAT:
                self._hear(received)
            elif received.to == self.provider.get_id():
                self._answer(received)
        self._announce()

    def _hear(self, heartbeat: Message) -> None:
        is_other = heartbeat.sender not in (self._peer, self._last_peer)
        if self._state is State.COLLECTING or (self._is_waiting and is_other):
            self._become_free()
        if not self._is_waiting and not self._flight.is_on_detour and self._will_meet(heartbeat):
            self._peer = heartbeat.sender
            self._state = State.REQUESTING
            self._wait()

    def _will_meet(self, other: Message) -> bool:
        following = self._course.following
        return -1 in (following, other.following) or following in (other.following, other.last)

    def _answer(self, message: Message) -> None:
        if message.kind == Kind.REQUEST:
            if self._state is State.COLLECTING:
                self._become_free()
            if not self._is_waiting:
                self._peer = message.sender
                self._wait()
            if self._peer == message.sender and self._state is not State.DONE:
                self._state = State.PAIRED
        elif message.sender == self._peer and self._state is not State.DONE and self._exchange(message):
            self._state = State.DONE

    def _exchange(self, message: Message) -> bool:
        """Exchange data with the sender of a confirmation, and part. Return whether that happened."""
        raise NotImplementedError

    def _collect(self, message: Message) -> None:
        """Take the data of a sensor."""
        raise NotImplementedError

    @property
    def _is_station(self) -> bool:
        return not self._flight.waypoints

    def _is_nearer(self, other: Message) -> bool:
        """Return whether the data of a pair goes to this node: to the one nearer to the ground station."""
        if self._is_station or other.is_from_ground:
            return self._is_station
        return (self._course.last, self.provider.get_id()) < (other.last, other.sender)

    def _carry(self, load: int) -> None:
        self._load = load
        self._track_load(load)

    def _wait(self) -> None:
        self.provider.cancel_timer("timeout")
        self._is_waiting = self.timeout_duration > 0
        if self._is_waiting:
            self.provider.schedule_timer("timeout", self.provider.current_time() + self.timeout_duration)

    def _become_free(self) -> None:
        self.provider.cancel_timer("timeout")
        self._is_waiting = False
        self._last_peer, self._peer = self._peer, -1
        self._state = State.FREE
        self._announce()

    def _announce(self) -> None:
        """Say what the state demands."""
        if not self._is_waiting:
            self._state = State.FREE
            self._course, self._stable_load = self._flight.course, self._load
        kind, peer, data = {
            State.REQUESTING: (Kind.REQUEST, self._peer, 5),
            State.PAIRED: (Kind.CONFIRMATION, self._peer, self._stable_load),
            State.DONE: (Kind.CONFIRMATION, self._peer, self._stable_load),
        }.get(self._state, (Kind.HEARTBEAT, -1, 5))
        course, number = self._course, self.provider.get_id()
        message = Message(kind, number, peer, course.following, course.last, int(course.is_reversed), data)
        self._say(self._completed(message).encoded(self.length), None if peer < 0 else peer)

    def _completed(self, message: Message) -> Message:
        """Return the message with what a subclass adds."""
        return message
