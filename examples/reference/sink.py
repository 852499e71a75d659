"""A node that only counts what it receives."""

from gradysim.protocol.interface import IProtocol


class Sink(IProtocol):
    """Counts the messages that arrive.

    Tracked variables, at the end:
        received: Messages from `count_from` on.
        received_bytes: Sum of their sizes.
    """

    count_from: float = 0.0
    """Seconds; earlier messages do not count."""

    def initialize(self) -> None:
        """Start the counts at 0."""
        self._received = 0
        self._received_bytes = 0

    def handle_packet(self, message: str) -> None:
        """Count a message."""
        if self.provider.current_time() >= self.count_from:
            self._received += 1
            self._received_bytes += len(message)

    def handle_timer(self, timer: str) -> None:
        """Do nothing: a sink has no timers."""

    def finish(self) -> None:
        """Track the counts."""
        self.provider.tracked_variables["received"] = self._received
        self.provider.tracked_variables["received_bytes"] = self._received_bytes
