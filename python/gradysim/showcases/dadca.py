"""DadcaProtocol and the protocols of its sensors and ground station: UAVs divide a tour among themselves.

After B. J. Olivieri de Souza and M. Endler, "Evaluating flight coordination approaches of UAV squads for WSN
data collection enhancing the internet range on WSN data collection", 2020, doi:10.1186/s13174-020-00125-4.
Two UAVs that meet tell each other how many they know on their side of the tour. They fly to the border of
their parts of it, and turn away from each other there.
"""

import math
from dataclasses import replace
from itertools import accumulate, pairwise
from typing import Annotated

from gradysim.showcases.communication import CommunicationProtocolBase
from gradysim.showcases.mission import Arrival, Course
from gradysim.showcases.pairing import Kind, Message, PairingProtocol

_LENGTH = 34


class DadcaProtocol(PairingProtocol):
    """Flies back and forth on its part of the mission, and hands its data towards the ground station.

    Tracked variables:
        data_load: Packets that it carries.
    """

    length = _LENGTH

    packet_limit: int = 1000
    """Most packets that it can carry; further ones are lost."""

    def initialize(self) -> None:
        """Start without neighbors."""
        self._left = self._right = 0
        super().initialize()

    def _arrive(self, arrival: Arrival) -> None:
        if arrival is Arrival.END:
            if self._flight.course.is_reversed:
                self._left = 0
            else:
                self._right = 0
            self._flight.turn()
        else:
            self._become_free()
            self._wait()

    def _exchange(self, message: Message) -> bool:
        has_station = self._is_station or message.is_from_ground
        if not has_station and self._course.is_reversed == bool(message.is_reversed):
            return False
        is_nearer = self._is_nearer(message)
        self._carry(self._limited(self._load + message.data) if is_nearer else 0)
        if not has_station:
            if is_nearer:
                self._right = message.right + 1
            else:
                self._left = message.left + 1
            self._meet_at_border()
        return True

    def _collect(self, message: Message) -> None:
        self._carry(self._limited(self._load + message.data))
        self._stable_load = self._load

    def _limited(self, load: int) -> int:
        return min(load, self.packet_limit)

    def _completed(self, message: Message) -> Message:
        return replace(message, left=self._left, right=self._right)

    def _meet_at_border(self) -> None:
        """Fly to the border of the own part of the tour and that of the other UAV, then away from it."""
        tour, course = self._flight.waypoints, self._course
        lengths = [0.0, *accumulate(math.dist(here, there) for here, there in pairwise(tour))]
        parts_before = self._left + (0 if course.is_reversed else 1)
        border = lengths[-1] * parts_before / (self._left + self._right + 1)
        leg = max((index for index in range(len(tour) - 1) if lengths[index] <= border), default=0)
        if len(tour) < 2 or lengths[leg] == lengths[leg + 1]:
            return
        share = (border - lengths[leg]) / (lengths[leg + 1] - lengths[leg])
        x, y, z = (a + share * (b - a) for a, b in zip(tour[leg], tour[leg + 1], strict=True))
        low, high = sorted((max(course.last, 0), course.following))
        between = tour[high : leg + 1] if leg >= high else tour[leg + 1 : low + 1][::-1]
        away = Course(leg + 1, leg, False) if course.is_reversed else Course(leg, leg + 1, True)
        self._flight.detour([*between, (x, y, z)], away)


class DadcaProtocolGround(DadcaProtocol):
    """Takes the data of each UAV that comes near.

    Tracked variables:
        data_load: Packets that have arrived.
    """

    packet_limit: int = 1_000_000_000
    """Most packets that it counts."""


class DadcaProtocolSensor(CommunicationProtocolBase):
    """Makes a packet now and then, and sends all of them to each UAV whose heartbeat it hears.

    Tracked variables:
        data_load: Packets that wait for a UAV.
    """

    generation_interval: Annotated[float, "s"] = 5.0
    """Time between two packets, > 0."""

    def initialize(self) -> None:
        """Start without packets."""
        super().initialize()
        if not self.generation_interval > 0:
            raise ValueError(f"generation_interval is {self.generation_interval} s, expected more than 0 s")
        self._waiting = 0
        self._track_load(0)
        self._schedule_packet()

    def handle_timer(self, timer: str) -> None:
        """Make a packet, or do what the base does."""
        if timer == "packet":
            self._waiting += 1
            self._track_load(self._waiting)
            self._schedule_packet()
        else:
            super().handle_timer(timer)

    def handle_packet(self, message: str) -> None:
        """Send all packets to the UAV of a heartbeat."""
        received = Message.decoded(message)
        if received and received.is_heartbeat_of_uav and not self._ignores(received.sender):
            data = Message(Kind.DATA, self.provider.get_id(), received.sender, data=self._waiting)
            self._send_to(received.sender, data.encoded(_LENGTH))
            self._waiting = 0
            self._track_load(0)

    def _schedule_packet(self) -> None:
        self.provider.schedule_timer("packet", self.provider.current_time() + self.generation_interval)
