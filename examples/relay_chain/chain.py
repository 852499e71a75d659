"""A chain of drones that relays a stream of messages to a base."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import SendMessageCommand


class Source(IProtocol):
    """Sends `rate` messages a second to its neighbor.

    Tracked variables:
        sent: Messages so far.
    """

    next_hop: str = "base"
    """Name of the neighbor."""
    rate: float = 200.0
    """Messages per second."""
    messages: int = 2000
    """Messages in all."""
    message_bytes: int = 1000
    """Size of a message."""

    def initialize(self) -> None:
        """Begin after a second."""
        self.provider.tracked_variables["sent"] = 0
        self.provider.schedule_timer("send", 1)

    def handle_timer(self, timer: str) -> None:
        """Send a message: its time, and as much as fits."""
        self.provider.tracked_variables["sent"] = sent = self.provider.tracked_variables["sent"] + 1
        message = f"{self.provider.current_time():.6f} ".ljust(self.message_bytes, "x")
        self.provider.send_communication_command(SendMessageCommand(message, self.next_hop))
        if sent < self.messages:
            self.provider.schedule_timer("send", 1 + sent / self.rate)

    def handle_packet(self, message: str) -> None:
        """Do nothing: a source only sends."""


class Relay(IProtocol):
    """Passes each message on."""

    next_hop: str = "base"
    """Name of the neighbor on the side of the base."""

    def initialize(self) -> None:
        """Do nothing: a relay waits for messages."""

    def handle_packet(self, message: str) -> None:
        """Pass a message on."""
        self.provider.send_communication_command(SendMessageCommand(message, self.next_hop))

    def handle_timer(self, timer: str) -> None:
        """Do nothing: relays have no timers."""


class Base(IProtocol):
    """Counts what arrives.

    Tracked variables:
        received: Messages so far.
        delay_s: Seconds from the source to here, of the last message.
    """

    def initialize(self) -> None:
        """Start the count at 0."""
        self.provider.tracked_variables.update(received=0, delay_s=0.0)

    def handle_packet(self, message: str) -> None:
        """Count a message."""
        self.provider.tracked_variables["received"] += 1
        delay_s = self.provider.current_time() - float(message.partition(" ")[0])
        self.provider.tracked_variables["delay_s"] = delay_s

    def handle_timer(self, timer: str) -> None:
        """Do nothing: a base has no timers."""
