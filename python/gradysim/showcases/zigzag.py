"""ZigzagProtocol and the protocol of its sensors: UAVs that meet turn around, and one takes all data."""

from gradysim.showcases.communication import CommunicationProtocolBase
from gradysim.showcases.pairing import Kind, Message, PairingProtocol, State

_LENGTH = 14


class ZigzagProtocol(PairingProtocol):
    """Flies along its mission, and turns around when it meets another UAV or the ground station.

    Of a pair, the UAV nearer to the ground station takes the data of both. If they fly in the same direction,
    only the one with the higher id turns around. A ground station has the same protocol without a mission.

    Tracked variables:
        data_load: Packets that the node carries, or that have arrived at the ground station.
    """

    length = _LENGTH

    def _exchange(self, message: Message) -> bool:
        meets = self._course.is_reversed != bool(message.is_reversed)
        self._carry(self._load + message.data if self._is_nearer(message) else 0)
        if meets or self.provider.get_id() > message.sender:
            self._flight.turn()
        return True

    def _collect(self, message: Message) -> None:
        if not self._is_waiting and self._state is State.FREE:
            self._carry(self._load + message.data)
            self._state, self._stable_load = State.COLLECTING, self._load
            self._wait()


class ZigzagProtocolSensor(CommunicationProtocolBase):
    """Sends data to the UAV that it heard last."""

    def handle_packet(self, message: str) -> None:
        """From now on send to the UAV of a heartbeat."""
        received = Message.decoded(message)
        if received and received.is_heartbeat_of_uav and not self._ignores(received.sender):
            data = Message(Kind.DATA, self.provider.get_id(), received.sender)
            self._say(data.encoded(_LENGTH), received.sender)
