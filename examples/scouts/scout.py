"""Scouts that fly at random and report to a base."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.plugin.random_mobility import RandomMobilityConfig, RandomMobilityPlugin


class Base(IProtocol):
    """Counts the reports that it receives.

    Tracked variables:
        reports: Number of reports so far.
    """

    def initialize(self) -> None:
        """Start the count at 0."""
        self.provider.tracked_variables["reports"] = 0

    def handle_packet(self, message: str) -> None:
        """Count a report."""
        self.provider.tracked_variables["reports"] += 1

    def handle_timer(self, timer: str) -> None:
        """Do nothing: a base has no timers."""


class Scout(IProtocol):
    """Flies from one random place to the next, and broadcasts a report each second."""

    jitter: float = 0.005
    """Longest delay of a report in seconds."""
    report_bytes: int = 1000
    """Size of a report."""

    def initialize(self) -> None:
        """Start the trip and schedule the first report."""
        box = RandomMobilityConfig(x_range=(-400, 400), y_range=(-400, 400), z_range=(40, 60), tolerance=1)
        self._trip = RandomMobilityPlugin(self, box)
        self._trip.initiate_random_trip()
        self._reports = 0
        self._schedule()

    def _schedule(self) -> None:
        self._reports += 1
        self.provider.schedule_timer("report", self._reports + self.provider.random.uniform(0, self.jitter))

    def handle_timer(self, timer: str) -> None:
        """Send a report."""
        self.provider.send_communication_command(BroadcastMessageCommand("x" * self.report_bytes))
        self._schedule()

    def handle_packet(self, message: str) -> None:
        """Do nothing: scouts ignore the reports of others."""
