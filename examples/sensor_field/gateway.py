"""A node between two networks: what it hears in the one it hands on in the other."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import SendMessageCommand
from gradysim.protocol.messages.telemetry import Telemetry


class Gateway(IProtocol):
    """Sends each message that it gets on to one node, through one of its network interfaces.

    Tracked variables, at the end:
        handed_on: Messages handed to that interface.
    """

    destination: int = 0
    """Id of the node that the messages go to."""
    interface: int = 1
    """Index of the interface that they go through: 1 for wlan[1]."""

    def initialize(self) -> None:
        """Start at zero."""
        self._handed_on = 0

    def handle_packet(self, message: str) -> None:
        """Hand it on."""
        command = SendMessageCommand(message, self.destination, interface=self.interface)
        self.provider.send_communication_command(command)
        self._handed_on += 1

    def handle_timer(self, timer: str) -> None:
        """A gateway has no timers."""

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        """Where it is does not matter."""

    def finish(self) -> None:
        """Show the count."""
        self.provider.tracked_variables["handed_on"] = self._handed_on
