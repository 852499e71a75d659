"""Plugin that flies a node along a list of waypoints, once or in a loop."""

import logging
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from os import PathLike
from pathlib import Path

from gradysim.protocol.checked_values import checked_number, checked_point
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand, SetSpeedMobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.plugin.attachment import configuration_or_default, warn_without_telemetry
from gradysim.protocol.plugin.dispatcher import create_dispatcher
from gradysim.protocol.position import Position

_logger = logging.getLogger(__name__)


class LoopMission(Enum):
    """What happens after the last waypoint of a mission.

    Attributes:
        NO: The mission ends there.
        RESTART: The first waypoint is next.
        REVERSE: The waypoints are flown in reverse order, then forward again from the first one.
    """

    NO = 1
    RESTART = 2
    REVERSE = 3


@dataclass
class MissionMobilityConfiguration:
    """How a mission is flown.

    Attributes:
        speed: m/s, >= 0.
        loop_mission: What happens after the last waypoint.
        tolerance: A waypoint counts as reached at this distance or less; m, >= 0.
    """

    speed: float = 5
    loop_mission: LoopMission = LoopMission.NO
    tolerance: float = 0.5


class MissionMobilityPluginException(Exception):  # noqa: N818 (the published name)
    """A mission is not valid, or a call does not fit the mission in progress."""


class MissionMobilityPlugin:
    """Sends the mobility commands of a mission. The telemetry of the node drives it.

    The plugin is idle until a mission starts, and again when a mission without a loop has reached its last
    waypoint.
    """

    def __init__(
        self, protocol: IProtocol, configuration: MissionMobilityConfiguration | None = None
    ) -> None:
        """Attach to `protocol`; without a configuration its defaults hold."""
        self._protocol = protocol
        self._configuration = configuration_or_default(self, configuration, MissionMobilityConfiguration)
        error = MissionMobilityPluginException
        checked_number("speed of a mission", self._configuration.speed, 0, unit="m/s", error=error)
        checked_number("tolerance of a mission", self._configuration.tolerance, 0, unit="m", error=error)
        if not isinstance(loop := self._configuration.loop_mission, LoopMission):
            raise error(f"loop_mission must be one of LoopMission, got {loop!r}")
        self._dispatcher = create_dispatcher(protocol)
        self._mission: tuple[Position, ...] = ()
        self._waypoint = 0
        self._reversed = False

    @property
    def current_waypoint(self) -> int | None:
        """Index of the current waypoint; None when idle."""
        return self._waypoint if self._mission else None

    @property
    def is_reversed(self) -> bool:
        """Whether the waypoints are flown from the last to the first."""
        return self._reversed

    @property
    def is_idle(self) -> bool:
        """Whether no mission is in progress."""
        return not self._mission

    def start_mission(self, mission: Sequence[Position]) -> None:
        """Start a mission at its first waypoint, (x, y, z) in meters. It replaces a mission in progress.

        Raise MissionMobilityPluginException if there is no waypoint, or one is not three finite numbers.
        """
        waypoints = tuple(
            checked_point(f"waypoint {index}", waypoint, MissionMobilityPluginException)
            for index, waypoint in enumerate(mission)
        )
        if not waypoints:
            raise MissionMobilityPluginException("a mission needs at least one waypoint, got none")
        if self.is_idle:
            self._dispatcher.register_handle_telemetry(self._handle_telemetry)
        self._mission = waypoints
        self._reversed = False
        self._go_to(0)
        self._protocol.provider.send_mobility_command(SetSpeedMobilityCommand(self._configuration.speed))
        if len(waypoints) > 1:
            warn_without_telemetry(
                _logger, self._protocol, "a mission does not get beyond its first waypoint"
            )

    def start_mission_with_waypoint_file(self, mission_file_path: str | PathLike[str]) -> None:
        """Like `start_mission`, with the waypoints of a text file: one `x,y,z` in meters per line.

        Empty lines are skipped. A relative path starts at the working directory.
        MissionMobilityPluginException if the file cannot be read or is empty, or a line is not three finite
        numbers.
        """
        try:
            text = Path(mission_file_path).read_text(encoding="utf-8-sig")
        except (OSError, UnicodeDecodeError) as error:
            raise MissionMobilityPluginException(
                f"cannot read the mission file {Path(mission_file_path).absolute()}: {error}"
            ) from error
        mission: list[Position] = []
        for number, line in enumerate(text.splitlines(), start=1):
            if not line.strip():
                continue
            try:
                mission.append(checked_point("a waypoint", line.split(","), ValueError))
            except ValueError:
                raise MissionMobilityPluginException(
                    f"{mission_file_path}:{number}: expected a waypoint x,y,z of finite numbers in meters, "
                    f"got {line.strip()!r}"
                ) from None
        if not mission:
            raise MissionMobilityPluginException(
                f"{mission_file_path}: a mission needs at least one waypoint"
            )
        self.start_mission(mission)

    def stop_mission(self) -> None:
        """Become idle; no-op when idle. The vehicle still flies to its last target."""
        if self.is_idle:
            return
        self._dispatcher.unregister_handle_telemetry(self._handle_telemetry)
        self._mission = ()
        self._reversed = False

    def set_current_waypoint(self, waypoint: int) -> None:
        """Fly to the waypoint with that index now, and continue from there in the same direction.

        Raise MissionMobilityPluginException if no mission is in progress, or it does not have this waypoint.
        """
        self._require_mission("set the current waypoint")
        if isinstance(waypoint, bool) or not isinstance(waypoint, int):
            raise MissionMobilityPluginException(f"a waypoint's index is an integer, got {waypoint!r}")
        if not 0 <= waypoint < len(self._mission):
            raise MissionMobilityPluginException(
                f"there is no waypoint {waypoint}: the mission has waypoints 0 to {len(self._mission) - 1}"
            )
        self._go_to(waypoint)

    def set_reversed(self, reversed: bool) -> None:
        """Set the direction, and fly to its next waypoint; no-op if this is the direction already.

        At the end of the mission, the waypoint stays the same. MissionMobilityPluginException if no mission
        is in progress, or it does not loop with REVERSE.
        """
        self._require_mission("reverse the mission")
        if self._configuration.loop_mission is not LoopMission.REVERSE:
            raise MissionMobilityPluginException(
                "only a mission with loop_mission REVERSE can be reversed, this one has "
                f"{self._configuration.loop_mission.name}"
            )
        if reversed == self._reversed:
            return
        self._reversed = bool(reversed)
        step = -1 if self._reversed else 1
        self._go_to(min(max(self._waypoint + step, 0), len(self._mission) - 1))

    def _handle_telemetry(self, _protocol: IProtocol, telemetry: Telemetry) -> None:
        # A handler before this one may have stopped the mission.
        if self._mission:
            # squared_distance, inlined, x first: this runs at every telemetry of every vehicle.
            x, y, z = telemetry.current_position
            target_x, target_y, target_z = self._mission[self._waypoint]
            dx = x - target_x
            tolerance = self._configuration.tolerance
            if dx * dx > tolerance * tolerance:
                return
            dy, dz = y - target_y, z - target_z
            if dx * dx + dy * dy + dz * dz <= tolerance * tolerance:
                self._advance()

    def _advance(self) -> None:
        last = len(self._mission) - 1
        following = self._waypoint + (-1 if self._reversed else 1)
        if not 0 <= following <= last:
            match self._configuration.loop_mission:
                case LoopMission.NO:
                    _logger.info("Mission: finished")
                    self.stop_mission()
                    return
                case LoopMission.RESTART:
                    following = 0
                case LoopMission.REVERSE:
                    self._reversed = not self._reversed
                    following = max(last - 1, 0) if self._reversed else min(1, last)
        # The loop of a single waypoint stays there, without a command for each telemetry.
        if following != self._waypoint:
            self._go_to(following)

    def _go_to(self, waypoint: int) -> None:
        self._waypoint = waypoint
        _logger.info("Mission: Going to waypoint %s", waypoint)
        self._protocol.provider.send_mobility_command(GotoCoordsMobilityCommand(*self._mission[waypoint]))

    def _require_mission(self, purpose: str) -> None:
        if self.is_idle:
            raise MissionMobilityPluginException(f"cannot {purpose}: no mission is in progress")
