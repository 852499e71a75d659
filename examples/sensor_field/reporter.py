"""A sensor that sends its measurements to one node periodically."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import SendMessageCommand


class Reporter(IProtocol):
    """Sends a report in every period of `period` seconds, up to `jitter` seconds after its start.

    Tracked variables, at the end:
        sent: Reports handed to the network interface.
    """

    destination: int = 0
    """Id of the destination node."""
    period: float = 10.0
    """Seconds, > 0."""
    jitter: float = 10.0
    """Seconds, from 0 to the period. With 0 all sensors send at the same instant."""
    payload_bytes: int = 40
    """Size of a report; an 802.15.4 frame has room for 90."""

    def initialize(self) -> None:
        """Schedule the first report."""
        if not 0 <= self.jitter <= self.period or not self.period > 0:
            raise ValueError(
                f"period is {self.period} s and jitter {self.jitter} s, expected 0 <= jitter <= period > 0"
            )
        self._periods = 0
        self._sent = 0
        self._schedule()

    def _schedule(self) -> None:
        time = self._periods * self.period + self.provider.random.uniform(0, self.jitter)
        self._periods += 1
        self.provider.schedule_timer("report", time)

    def handle_timer(self, timer: str) -> None:
        """Send a report: id, number, and measured values up to the size."""
        report = f"{self.provider.get_id()} {self._sent} ".ljust(self.payload_bytes, "7")
        self.provider.send_communication_command(SendMessageCommand(report, self.destination))
        self._sent += 1
        self._schedule()

    def handle_packet(self, message: str) -> None:
        """Do nothing: a sensor does not receive messages."""

    def finish(self) -> None:
        """Show the count."""
        self.provider.tracked_variables["sent"] = self._sent
