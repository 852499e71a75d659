"""Drones that search an area in lanes for beacons, such as those of hikers, and report to a base."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.protocol.plugin.mission_mobility import MissionMobilityConfiguration, MissionMobilityPlugin
from gradysim.protocol.position import Position


class Beacon(IProtocol):
    """Broadcasts its id once a second."""

    def initialize(self) -> None:
        """Begin at a random moment: beacons are not synchronized."""
        self.provider.schedule_timer("send", self.provider.random.uniform(0, 1))

    def handle_timer(self, timer: str) -> None:
        """Send the id."""
        self.provider.send_communication_command(BroadcastMessageCommand(str(self.provider.get_id())))
        self.provider.schedule_timer("send", self.provider.current_time() + 1)

    def handle_packet(self, message: str) -> None:
        """Do nothing: a beacon only sends."""


class Searcher(IProtocol):
    """Flies along every n-th lane of the area, and passes what it hears on to the base."""

    lane: float = 100.0
    """Meters between two lanes."""
    side: float = 800.0
    """Meters: the area is a square."""
    number: int = 0
    """Which of the fleet this one is, from 0."""
    fleet: int = 2
    """Number of searchers."""

    def initialize(self) -> None:
        """Plan the flight: there along one lane, back along the next one."""
        centers = [self.lane * (k + 0.5) for k in range(round(self.side / self.lane))]
        route: list[Position] = []
        for k, y in enumerate(centers[self.number :: self.fleet]):
            ends = [(0.0, y, 30.0), (self.side, y, 30.0)]
            route += reversed(ends) if k % 2 else ends
        mission = MissionMobilityPlugin(self, MissionMobilityConfiguration(speed=15, tolerance=2))
        mission.start_mission(route)

    def handle_packet(self, message: str) -> None:
        """Report a beacon, again each time that it is heard: a report may be lost."""
        self.provider.send_communication_command(SendMessageCommand(message, "base"))

    def handle_timer(self, timer: str) -> None:
        """Do nothing: searchers have no timers."""


class Base(IProtocol):
    """Collects the reports.

    Tracked variables:
        found: Number of different beacons so far.
        last_find_s: Time of the last find, in seconds.
    """

    def initialize(self) -> None:
        """Start with nothing found."""
        self._beacons: set[str] = set()
        self.provider.tracked_variables.update(found=0, last_find_s=0.0)

    def handle_packet(self, message: str) -> None:
        """Note a beacon."""
        if message not in self._beacons:
            self._beacons.add(message)
            self.provider.tracked_variables["found"] = len(self._beacons)
            self.provider.tracked_variables["last_find_s"] = self.provider.current_time()

    def handle_timer(self, timer: str) -> None:
        """Do nothing: a base has no timers."""
