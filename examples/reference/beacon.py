"""A node that broadcasts at regular times and counts its receptions."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand


class Beacon(IProtocol):
    """Broadcasts a message of fixed size: number k is sent at first_send + offset + k * interval.

    The offset is drawn once per node, between 0 and `spread`. With a spread of 0 s all nodes with the same
    `first_send` send at exactly the same instants.

    Tracked variables, at the end:
        sent: Messages handed to the radio.
        received: Messages received.
    """

    first_send: float = 1.0
    """Seconds; not negative."""
    spread: float = 0.0
    """Longest offset in seconds; not negative."""
    interval: float = 1.0
    """Seconds between two messages, > 0."""
    stop: float = 60.9
    """Seconds; the node does not send from this time on."""
    payload_bytes: int = 100
    """Size of a message."""

    def initialize(self) -> None:
        """Schedule the first message."""
        if not self.interval > 0:
            raise ValueError(f"interval is {self.interval} s, expected more than 0 s")
        self._start = self.first_send + self.provider.random.uniform(0, self.spread)
        self._command = BroadcastMessageCommand("x" * self.payload_bytes)
        self._sent = 0
        self._received = 0
        self._schedule()

    def _schedule(self) -> None:
        # Multiplied, not added up: all nodes round in the same way, and errors do not grow.
        time = self._start + self._sent * self.interval
        if time < self.stop:
            self.provider.schedule_timer("beacon", time)

    def handle_timer(self, timer: str) -> None:
        """Send a message."""
        self.provider.send_communication_command(self._command)
        self._sent += 1
        self._schedule()

    def handle_packet(self, message: str) -> None:
        """Count a message."""
        self._received += 1

    def finish(self) -> None:
        """Track the counts."""
        self.provider.tracked_variables["sent"] = self._sent
        self.provider.tracked_variables["received"] = self._received
