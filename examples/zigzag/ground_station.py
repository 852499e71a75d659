"""Ground station of ZigZag."""

from custody import Custody
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from heartbeat import HeartbeatClock
from message import (
    GroundHeartbeat,
    PairConfirmation,
    PairRequest,
    UavHeartbeat,
    decode,
    encode,
)


class ZigZagGroundStation(IProtocol):
    """Stands still and takes all data of each UAV in range. The UAV then flies away from it.

    It exchanges data like a UAV (see `ZigZagMobile`), but it is always the carrier and always available.

    Tracked variables:
        data: Readings that have arrived: the result of the mission.
        deliveries: Number of exchanges that brought readings.
    """

    heartbeat_interval: float = 1.0
    """Seconds between two heartbeats."""
    heartbeat_jitter: float = 0.1
    """Longest random delay of a heartbeat in seconds; 0: all nodes send at the same instants."""

    def initialize(self) -> None:
        """Start without data, and schedule the first heartbeat."""
        self._custody = Custody()
        self._deliveries = 0
        self._heartbeats = HeartbeatClock(
            self.heartbeat_interval,
            self.heartbeat_jitter,
            start=self.provider.current_time(),
            random=self.provider.random,
        )
        self.provider.tracked_variables["data"] = 0
        self.provider.tracked_variables["deliveries"] = 0
        self.provider.schedule_timer("heartbeat", self._heartbeats.next())

    def handle_timer(self, timer: str) -> None:
        """Send a heartbeat, which is the only timer."""
        heartbeat = GroundHeartbeat(sender=self.provider.get_id())
        self.provider.send_communication_command(BroadcastMessageCommand(encode(heartbeat)))
        self.provider.schedule_timer("heartbeat", self._heartbeats.next())

    def handle_packet(self, message: str) -> None:
        """Request the data of a UAV that is in range, and take the data of its messages."""
        me = self.provider.get_id()
        match decode(message):
            case UavHeartbeat(sender=uav, available=True):
                self._send(PairRequest(sender=me, carrier=me, given=0), uav)
            case PairRequest(sender=uav, given=given):
                self._take(uav, given)
                self._send(PairConfirmation(sender=me, carrier=me, given=0), uav)
            case PairConfirmation(sender=uav, given=given):
                self._take(uav, given)

    def _take(self, uav: int, given: int) -> None:
        if self._custody.take(uav, given):
            self._deliveries += 1
            self.provider.tracked_variables["data"] = self._custody.held
            self.provider.tracked_variables["deliveries"] = self._deliveries

    def _send(self, message: PairRequest | PairConfirmation, destination: int) -> None:
        self.provider.send_communication_command(SendMessageCommand(encode(message), destination))
