"""Missions of the showcases: a list of waypoints, along which a vehicle can turn around."""

import math
from collections.abc import Sequence
from enum import Enum
from typing import Annotated, NamedTuple

from gradysim.protocol.interface import IProvider
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.position import Position
from gradysim.showcases.communication import CommunicationProtocolBase

BACK = "back"
"""The last word of a mission that ends with the way back."""


class Course(NamedTuple):
    """Where a vehicle is in its mission.

    Attributes:
        following: Index of the waypoint that it flies to; -1 without a mission.
        last: Index of the waypoint that it comes from; -1 if there is none.
        is_reversed: Whether it flies towards the first waypoint.
    """

    following: int = -1
    last: int = -1
    is_reversed: bool = False


class Arrival(Enum):
    """Where a vehicle has just arrived, if it is not an ordinary waypoint."""

    END = "an end of the mission, where the vehicle stays"
    MEETING = "the end of a detour, after which the vehicle flies on"


class Mission:
    """Sends the mobility commands of a mission. The telemetry of the node drives it.

    Attributes:
        waypoints: (x, y, z) in meters.
        course: Where the vehicle is in the mission.
    """

    def __init__(self, provider: IProvider, text: str, tolerance_m: float) -> None:
        """Take a mission such as "0 0 20, 100 0 20, back". A waypoint is reached within `tolerance_m`.

        Raises:
            ValueError: A waypoint is not three finite numbers.
        """
        points, self._comes_back = text.strip(), False
        if points.endswith(BACK):
            points, self._comes_back = points.removesuffix(BACK).rstrip(" ,"), True
        self.waypoints = [_position(part) for part in points.split(",") if part.strip()]
        self.course = Course(0 if self.waypoints else -1)
        self._provider = provider
        self._tolerance_m = tolerance_m
        self._has_started = False
        self._targets: list[Position] = []
        self._after_detour: Course | None = None

    @property
    def is_on_detour(self) -> bool:
        """Whether the vehicle is on a detour."""
        return self._after_detour is not None

    def start(self) -> None:
        """Fly to the first waypoint, if there is one. Until then, no other call has an effect."""
        self._has_started = bool(self.waypoints)
        self._fly(self.course, self.waypoints[:1])

    def turn(self) -> None:
        """Fly towards the waypoint that the vehicle comes from, and on in that direction."""
        following, _, is_reversed = self.course
        back = min(max(following + (1 if is_reversed else -1), 0), len(self.waypoints) - 1)
        self._fly(Course(back, following, not is_reversed), self.waypoints[back : back + 1])

    def detour(self, points: Sequence[Position], course: Course) -> None:
        """Fly to some points, then on with that course."""
        self._fly(self.course, points)
        self._after_detour = course if self._has_started else None

    def advance(self, position: Position) -> Arrival | None:
        """Take the position of the vehicle, and fly on if it has reached its target."""
        if not self._targets or math.dist(position, self._targets[0]) > self._tolerance_m:
            return None
        del self._targets[0]
        if self._targets:
            self._go()
            return None
        if (course := self._after_detour) is not None:
            self._fly(course, [self.waypoints[course.following]])
            return Arrival.MEETING
        reached, _, is_reversed = self.course
        following = reached + (-1 if is_reversed else 1)
        if 0 <= following < len(self.waypoints):
            self._fly(Course(following, reached, is_reversed), [self.waypoints[following]])
        elif self._comes_back and not is_reversed:
            self.turn()
        else:
            self.course = Course(reached, reached, is_reversed)
            return Arrival.END
        return None

    def _fly(self, course: Course, targets: Sequence[Position]) -> None:
        if self._has_started:
            self.course, self._targets, self._after_detour = course, list(targets), None
            self._go()

    def _go(self) -> None:
        self._provider.send_mobility_command(GotoCoordsMobilityCommand(*self._targets[0]))


class FlyingProtocol(CommunicationProtocolBase):
    """A protocol whose node flies a mission. A node without a mission stays where it is."""

    mission: str = ""
    """x, y and z of the waypoints in meters, "0 0 20, 100 0 20". With ", back" the vehicle then returns."""
    tolerance: Annotated[float, "m"] = 1.0
    """A waypoint is reached within this distance."""
    takeoff_time: Annotated[float, "s"] = 0.0
    """The mission starts then; at 0 if it is negative."""

    def initialize(self) -> None:
        """Prepare the mission."""
        super().initialize()
        self._flight = Mission(self.provider, self.mission, self.tolerance)
        if self._flight.waypoints:
            self.provider.schedule_timer("takeoff", max(self.takeoff_time, 0.0))

    def handle_timer(self, timer: str) -> None:
        """Start the mission, or do what the base does."""
        if timer == "takeoff":
            self._flight.start()
        else:
            super().handle_timer(timer)

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        """Fly on."""
        if arrival := self._flight.advance(telemetry.current_position):
            self._arrive(arrival)

    def _arrive(self, arrival: Arrival) -> None:
        """Do something at the end of the mission, or of a detour."""


def _position(text: str) -> Position:
    try:
        x, y, z = map(float, text.split())
    except ValueError:
        x = y = z = math.nan
    if not math.isfinite(x + y + z):
        raise ValueError(f"a waypoint is three numbers in meters, got `{text.strip()}`")
    return x, y, z
