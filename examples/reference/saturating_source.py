"""A node that always has something to send."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import CommunicationCommand, SendMessageCommand


class SaturatingSource(IProtocol):
    """Sends messages to one node, faster than the channel can carry them: its queue never runs empty.

    The defaults offer 32 Mbps of payload, more than one station can send at any rate of 802.11 b, g or a. The
    queue drops messages that do not fit.
    """

    destination: int = 0
    """Id of the destination node."""
    payload_bytes: int = 1000
    """Size of a message."""
    burst: int = 4
    """Messages per burst."""
    interval: float = 0.001
    """Seconds between two bursts, > 0."""
    spread: float = 0.0
    """Latest time of the first burst in seconds, drawn once per node; not negative."""

    def initialize(self) -> None:
        """Schedule the first burst."""
        if not self.interval > 0:
            raise ValueError(f"interval is {self.interval} s, expected more than 0 s")
        self._command: CommunicationCommand = SendMessageCommand("x" * self.payload_bytes, self.destination)
        self._bursts = 0
        self._start = self.provider.random.uniform(0, self.spread)
        self.provider.schedule_timer("burst", self._start)

    def handle_timer(self, timer: str) -> None:
        """Fill the queue."""
        for _ in range(self.burst):
            self.provider.send_communication_command(self._command)
        self._bursts += 1
        self.provider.schedule_timer("burst", self._start + self._bursts * self.interval)

    def handle_packet(self, message: str) -> None:
        """Do nothing: a source does not receive messages."""
