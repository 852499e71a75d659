"""The destination of the sensors' reports."""

from collections import Counter

from gradysim.protocol.interface import IProtocol


class Collector(IProtocol):
    """Counts the reports of each sensor.

    Tracked variables, at the end:
        received: All reports.
        sensors_heard: Number of sensors with at least one report.
    """

    def initialize(self) -> None:
        """Start the counts at 0."""
        self._reports: Counter[str] = Counter()

    def handle_packet(self, message: str) -> None:
        """Count a report, which starts with the id of its sensor."""
        self._reports[message.partition(" ")[0]] += 1

    def handle_timer(self, timer: str) -> None:
        """Do nothing: a collector has no timers."""

    def finish(self) -> None:
        """Track the counts."""
        self.provider.tracked_variables["received"] = self._reports.total()
        self.provider.tracked_variables["sensors_heard"] = len(self._reports)
