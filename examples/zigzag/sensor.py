"""Sensor of ZigZag."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import SendMessageCommand
from message import SensorData, UavHeartbeat, decode, encode


class ZigZagSensor(IProtocol):
    """Stands still and answers each heartbeat of a UAV with a reading.

    Tracked variables:
        answered: Readings sent so far.
    """

    def initialize(self) -> None:
        """Start the count at 0."""
        self._answered = 0
        self.provider.tracked_variables["answered"] = self._answered

    def handle_packet(self, message: str) -> None:
        """Answer the heartbeat of a UAV. Ignore other messages."""
        match decode(message):
            case UavHeartbeat(sender=uav):
                reading = SensorData(sender=self.provider.get_id())
                self.provider.send_communication_command(SendMessageCommand(encode(reading), uav))
                self._answered += 1
                self.provider.tracked_variables["answered"] = self._answered

    def handle_timer(self, timer: str) -> None:
        """Do nothing: a sensor has no timers."""
