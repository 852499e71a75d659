"""The node that the sensors report to."""

from collections import Counter

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.telemetry import Telemetry


class Collector(IProtocol):
    """Counts the reports of each sensor.

    Tracked variables, at the end:
        received: All reports.
        sensors_heard: Sensors that at least one report came from.
    """

    def initialize(self) -> None:
        """Start at zero."""
        self._reports: Counter[str] = Counter()

    def handle_packet(self, message: str) -> None:
        """Count; a report begins with the id of its sensor."""
        self._reports[message.partition(" ")[0]] += 1

    def handle_timer(self, timer: str) -> None:
        """A collector has no timers."""

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        """Where it is does not matter."""

    def finish(self) -> None:
        """Show the counts."""
        self.provider.tracked_variables["received"] = self._reports.total()
        self.provider.tracked_variables["sensors_heard"] = len(self._reports)
