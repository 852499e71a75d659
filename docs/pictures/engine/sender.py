"""The protocol of the runs that `draw.py` shows."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import (
    BroadcastMessageCommand,
    CommunicationCommand,
    SendMessageCommand,
)


class Sender(IProtocol):
    """Sends one message, if it has a time for it."""

    at = -1.0
    """Time in s; -1: never."""
    to = -1
    """Id of the node that gets the message; -1: all nodes."""
    size = 200
    """Bytes of the message."""

    def initialize(self) -> None:
        """Wait for the time."""
        if self.at >= 0:
            self.provider.schedule_timer("send", self.at)

    def handle_timer(self, timer: str) -> None:
        """Send the message."""
        message = "." * self.size
        command: CommunicationCommand = (
            BroadcastMessageCommand(message) if self.to < 0 else SendMessageCommand(message, self.to)
        )
        self.provider.send_communication_command(command)

    def handle_packet(self, message: str) -> None:
        """Ignore what others send."""
