"""A node that always has something to send, and counts what it receives."""

from gradysim.protocol.messages.communication import BroadcastMessageCommand
from saturating_source import SaturatingSource


class SaturatedPeer(SaturatingSource):
    """Sends like a SaturatingSource, to one node or to all, and counts like a Sink.

    Tracked variables, at the end:
        received: Messages from `count_from` on.
    """

    count_from: float = 0.0
    """Seconds; earlier messages do not count."""
    is_broadcast: bool = False
    """Whether all nodes are the destination."""

    def initialize(self) -> None:
        """Schedule the first burst, and start the count at 0."""
        super().initialize()
        if self.is_broadcast:
            self._command = BroadcastMessageCommand("x" * self.payload_bytes)
        self._received = 0

    def handle_packet(self, message: str) -> None:
        """Count a message."""
        if self.provider.current_time() >= self.count_from:
            self._received += 1

    def finish(self) -> None:
        """Track the count."""
        self.provider.tracked_variables["received"] = self._received
