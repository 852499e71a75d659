"""Hovering drones that broadcast an alert to people on the ground."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand


class Drone(IProtocol):
    """Flies to its cell of a square grid, and broadcasts the parts of the alert once there is time for it.

    All drones send the same part in the same interval, each at a random moment of it.
    """

    number: int = 0
    """Which of the fleet this one is, from 0."""
    rows: int = 3
    """The fleet has rows x rows drones."""
    side: float = 800.0
    """Meters: the area is a square."""
    start: float = 45.0
    """Seconds: time of the first part."""
    parts: int = 200
    """Number of parts."""
    interval: float = 0.02
    """Seconds from one part to the next."""
    part_bytes: int = 1000
    """Size of a part."""

    def initialize(self) -> None:
        """Fly to the middle of the cell."""
        cell = self.side / self.rows
        row, column = divmod(self.number, self.rows)
        place = (cell * (column + 0.5), cell * (row + 0.5), 50)
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(*place))
        self._part = 0
        self._plan()

    def _plan(self) -> None:
        moment = self._part + self.provider.random.random()
        self.provider.schedule_timer("send", self.start + moment * self.interval)

    def handle_timer(self, timer: str) -> None:
        """Send a part: its number, and as much as fits."""
        message = f"{self._part} ".ljust(self.part_bytes, "x")
        self.provider.send_communication_command(BroadcastMessageCommand(message))
        self._part += 1
        if self._part < self.parts:
            self._plan()

    def handle_packet(self, message: str) -> None:
        """Do nothing: drones do not listen."""


class Person(IProtocol):
    """Collects the parts.

    Tracked variables:
        parts: Number of different parts so far.
    """

    def initialize(self) -> None:
        """Start with none."""
        self._parts: set[str] = set()
        self.provider.tracked_variables["parts"] = 0

    def handle_packet(self, message: str) -> None:
        """Keep a part."""
        self._parts.add(message.partition(" ")[0])
        self.provider.tracked_variables["parts"] = len(self._parts)

    def handle_timer(self, timer: str) -> None:
        """Do nothing: people have no timers."""
