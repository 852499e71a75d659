"""A node that only counts what it receives."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.telemetry import Telemetry


class Sink(IProtocol):
    """Counts the messages that arrive.

    Tracked variables, at the end:
        received: Messages from `count_from` on.
        received_bytes: Sum of their sizes.
    """

    count_from: float = 0.0
    """Seconds; what arrives before is left out."""

    def initialize(self) -> None:
        """Start at zero."""
        self._received = 0
        self._received_bytes = 0

    def handle_packet(self, message: str) -> None:
        """Count."""
        if self.provider.current_time() >= self.count_from:
            self._received += 1
            self._received_bytes += len(message)

    def handle_timer(self, timer: str) -> None:
        """A sink has no timers."""

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        """Where it is does not matter."""

    def finish(self) -> None:
        """Show the counts."""
        self.provider.tracked_variables["received"] = self._received
        self.provider.tracked_variables["received_bytes"] = self._received_bytes
