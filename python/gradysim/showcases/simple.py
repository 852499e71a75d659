"""SimpleDroneProtocol and the protocols of sensors and ground station: UAVs carry data to the ground."""

from typing import Annotated

from gradysim.showcases.communication import CommunicationProtocolBase
from gradysim.showcases.mission import FlyingProtocol

_LENGTH = 7
"""Characters of a message: as many bytes as one has in the OMNeT++ project."""

_DRONE, _SENSOR, _GROUND = "D", "S", "G"


class SimpleDroneProtocol(FlyingProtocol):
    """Collects the data of sensors along its mission, and hands it to the ground station.

    Tracked variables:
        data_load: Packets that it carries.
    """

    timeout_duration: Annotated[float, "s"] = 3.0
    """Time after an exchange in which further ones are ignored."""

    def initialize(self) -> None:
        """Start without data."""
        super().initialize()
        self._ignores_until = 0.0
        self._carry(0)

    def handle_packet(self, message: str) -> None:
        """Take the data of a sensor, or give all data to the ground station."""
        sender, number, count = _decoded(message)
        if self._ignores(number) or self.provider.current_time() < self._ignores_until:
            return
        if sender == _SENSOR:
            self._exchange(self._load + count)
        elif sender == _GROUND and self._load:
            self._exchange(0)

    def _exchange(self, load: int) -> None:
        self._ignores_until = self.provider.current_time() + self.timeout_duration
        self._carry(load)

    def _carry(self, load: int) -> None:
        self._load = load
        self._track_load(load)
        self._say(_encoded(_DRONE, self.provider.get_id(), load), None)


class SimpleSensorProtocol(CommunicationProtocolBase):
    """Sends data to the UAV that it heard last."""

    payload_size: int = 5
    """Packets of data in a message."""

    def initialize(self) -> None:
        """Broadcast data until a UAV is heard."""
        super().initialize()
        self._say(_encoded(_SENSOR, self.provider.get_id(), self.payload_size), None)

    def handle_packet(self, message: str) -> None:
        """From now on send to this UAV."""
        sender, number, _ = _decoded(message)
        if sender == _DRONE and not self._ignores(number):
            self._target = number
            self._send()


class SimpleGroundProtocol(CommunicationProtocolBase):
    """Counts the data of UAVs, and answers them.

    Tracked variables:
        data_load: Packets that have arrived.
    """

    def initialize(self) -> None:
        """Start without data."""
        super().initialize()
        self._load = 0
        self._track_load(0)
        self._say(_encoded(_GROUND, self.provider.get_id(), 0), None)

    def handle_packet(self, message: str) -> None:
        """Take the data of a UAV."""
        sender, number, count = _decoded(message)
        if sender == _DRONE and not self._ignores(number):
            self._load += count
            self._track_load(self._load)
            self._send_to(number, self._message)


def _encoded(sender: str, number: int, count: int) -> str:
    return f"{sender}{number} {count}".ljust(_LENGTH)


def _decoded(message: str) -> tuple[str, int, int]:
    """Return the kind of the sender, its id and its number of packets; ("", 0, 0) for another message."""
    try:
        number, count = map(int, message[1:].split())
    except ValueError:
        return "", 0, 0
    return message[0], number, count
