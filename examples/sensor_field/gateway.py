"""A node in two networks, which forwards messages from one to the other."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import SendMessageCommand


class Gateway(IProtocol):
    """Forwards each received message to one node, through one of its network interfaces.

    Tracked variables, at the end:
        handed_on: Messages handed to that interface.
    """

    destination: int = 0
    """Id of the destination node."""
    interface: int = 1
    """Index of the outgoing interface: 1 for wlan[1]."""

    def initialize(self) -> None:
        """Start the count at 0."""
        self._handed_on = 0

    def handle_packet(self, message: str) -> None:
        """Forward a message."""
        command = SendMessageCommand(message, self.destination, interface=self.interface)
        self.provider.send_communication_command(command)
        self._handed_on += 1

    def handle_timer(self, timer: str) -> None:
        """Do nothing: a gateway has no timers."""

    def finish(self) -> None:
        """Track the count."""
        self.provider.tracked_variables["handed_on"] = self._handed_on
