"""Drones that upload photos to a base."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import SendMessageCommand


class Photographer(IProtocol):
    """Sends the parts of its photos to the base, at an even rate.

    Tracked variables:
        sent: Parts so far.
    """

    rate: float = 400.0
    """Parts per second."""
    seconds: float = 10.0
    """Duration of the upload."""
    part_bytes: int = 1000
    """Size of a part."""

    def initialize(self) -> None:
        """Begin at a random moment of the interval between two parts."""
        self.provider.tracked_variables["sent"] = 0
        self._start = self.provider.random.uniform(0, 1 / self.rate)
        self.provider.schedule_timer("send", self._start)

    def handle_timer(self, timer: str) -> None:
        """Send a part."""
        self.provider.tracked_variables["sent"] = sent = self.provider.tracked_variables["sent"] + 1
        self.provider.send_communication_command(SendMessageCommand("x" * self.part_bytes, "base"))
        if sent < self.rate * self.seconds:
            self.provider.schedule_timer("send", self._start + sent / self.rate)

    def handle_packet(self, message: str) -> None:
        """Do nothing: the base does not answer."""


class Base(IProtocol):
    """Counts the parts.

    Tracked variables:
        received: Parts so far.
    """

    def initialize(self) -> None:
        """Start the count at 0."""
        self.provider.tracked_variables["received"] = 0

    def handle_packet(self, message: str) -> None:
        """Count a part."""
        self.provider.tracked_variables["received"] += 1

    def handle_timer(self, timer: str) -> None:
        """Do nothing: a base has no timers."""
