"""Drones that cross a circle, and give way to those whose reports they hear."""

from math import dist

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry


class Drone(IProtocol):
    """Flies to the other side, reports its place ten times a second, and streams video to the base.

    Others closer than `clearance` push it away and to its right.

    Tracked variables:
        closest_m: Smallest distance so far to a drone whose report has arrived, in meters. The report says
            when it was sent, so a late one counts, too.
        age_s: Age of the oldest report when it arrived, in seconds.
    """

    clearance: float = 30.0
    """Meters."""
    video_mbps: float = 0.0
    """Mbps of the stream."""

    def initialize(self) -> None:
        """Fly to the mirror image of the start."""
        x, y, z = self.provider.initial_position or (0, 0, 0)
        self._target = (-x, -y, z)
        self._track: list[tuple[float, float]] = [(x, y)]
        self._others: dict[str, tuple[float, float]] = {}
        self.provider.tracked_variables.update(closest_m=200.0, age_s=0.0)
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(*self._target))
        self.provider.schedule_timer("report", self.provider.random.uniform(0, 0.1))
        if self.video_mbps > 0:
            self.provider.schedule_timer("video", self.provider.random.uniform(0, 0.1))

    def handle_timer(self, timer: str) -> None:
        """Send a report, or the next 1000 bytes of the stream, until the drone is there."""
        now = self.provider.current_time()
        x, y = self._track[-1]
        if dist((x, y), self._target[:2]) < 1:
            return
        if timer == "report":
            report = f"{self.provider.get_id()} {len(self._track) - 1} {x} {y}"
            self.provider.send_communication_command(BroadcastMessageCommand(report))
            self.provider.schedule_timer("report", now + 0.1)
        else:
            self.provider.send_communication_command(SendMessageCommand("x" * 1000, "base"))
            self.provider.schedule_timer("video", now + 0.008 / self.video_mbps)

    def handle_packet(self, message: str) -> None:
        """Note where another drone is, and how close it was when it sent the report."""
        other, tick, x, y = message.split()
        self._others[other] = there = (float(x), float(y))
        tracked = self.provider.tracked_variables
        tracked["closest_m"] = min(tracked["closest_m"], dist(there, self._track[int(tick)]))
        tracked["age_s"] = max(tracked["age_s"], 0.1 * (len(self._track) - 1 - int(tick)))

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        """Head for the target, and away from the others. Telemetry comes at the same instants everywhere."""
        x, y, z = telemetry.current_position
        self._track.append((x, y))
        left = max(dist((x, y), self._target[:2]), 0.1)
        way_x, way_y = (self._target[0] - x) / left, (self._target[1] - y) / left
        for other_x, other_y in self._others.values():
            distance = max(dist((x, y), (other_x, other_y)), 0.1)
            push = 2 * max(1 - distance / self.clearance, 0) / distance
            way_x += push * (x - other_x + y - other_y)
            way_y += push * (y - other_y - x + other_x)
        step = min(left, 10)
        command = GotoCoordsMobilityCommand(x + step * way_x, y + step * way_y, z)
        self.provider.send_mobility_command(command)


class Base(IProtocol):
    """Takes the streams."""

    def initialize(self) -> None:
        """Do nothing: a base waits for messages."""

    def handle_packet(self, message: str) -> None:
        """Do nothing: the video is not shown."""

    def handle_timer(self, timer: str) -> None:
        """Do nothing: a base has no timers."""
