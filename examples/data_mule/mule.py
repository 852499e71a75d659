"""A drone that flies over sensors and carries their stored readings home."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.protocol.plugin.mission_mobility import MissionMobilityConfiguration, MissionMobilityPlugin


class Sensor(IProtocol):
    """Hands out its readings, the next one when the mule has confirmed the last one.

    Tracked variables:
        left: Readings that the mule does not have yet, as far as the sensor knows.
    """

    readings: int = 1500
    """Readings in store."""
    reading_bytes: int = 1000
    """Size of a reading."""

    def initialize(self) -> None:
        """Start with a full store."""
        self._next = 0
        self._sent_at = 0.0
        self.provider.tracked_variables["left"] = self.readings

    def handle_packet(self, message: str) -> None:
        """Answer `got NUMBER`, and `here` if the exchange has stopped."""
        word, _, number = message.partition(" ")
        now = self.provider.current_time()
        if word == "got" and int(number) == self._next:
            self._next += 1
            self.provider.tracked_variables["left"] = self.readings - self._next
        elif word == "got" or now < self._sent_at + 0.2:
            return
        if self._next < self.readings:
            self._sent_at = now
            reading = f"{self.provider.get_id()} {self._next} ".ljust(self.reading_bytes, "x")
            self.provider.send_communication_command(SendMessageCommand(reading, "mule"))

    def handle_timer(self, timer: str) -> None:
        """Do nothing: a sensor waits for the mule."""


class Mule(IProtocol):
    """Flies along a route, calls once a second and confirms each reading.

    Tracked variables:
        readings: Number of different readings on board.
    """

    route: tuple[tuple[float, float, float], ...] = ((0, 0, 20), (800, 0, 20))
    """Waypoints in meters."""
    speed: float = 20.0
    """m/s."""

    def initialize(self) -> None:
        """Take off."""
        self._readings: set[tuple[str, str]] = set()
        self.provider.tracked_variables["readings"] = 0
        mission = MissionMobilityPlugin(self, MissionMobilityConfiguration(speed=self.speed, tolerance=5))
        mission.start_mission(self.route)
        self.provider.schedule_timer("call", 1)

    def handle_timer(self, timer: str) -> None:
        """Call."""
        self.provider.send_communication_command(BroadcastMessageCommand("here"))
        self.provider.schedule_timer("call", self.provider.current_time() + 1)

    def handle_packet(self, message: str) -> None:
        """Store a reading and confirm it."""
        sensor, number, _ = message.split(" ")
        self._readings.add((sensor, number))
        self.provider.tracked_variables["readings"] = len(self._readings)
        self.provider.send_communication_command(SendMessageCommand(f"got {number}", int(sensor)))
