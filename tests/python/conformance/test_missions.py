"""A mission is flown alike in both modes, for all loop modes, and so is a random trip.

If a waypoint counts as reached at exactly the tolerance, the rounding of positions decides. So the waypoints
here are at odd distances.
"""

from collections import Counter
from typing import ClassVar

import pytest
from perfect_channel import Case
from watched_run import UPDATE_S, assert_same, trace_case

from gradysim.protocol.messages.mobility import GotoGeoCoordsMobilityCommand, SetSpeedMobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.plugin.mission_mobility import (
    LoopMission,
    MissionMobilityConfiguration,
    MissionMobilityPlugin,
)
from gradysim.protocol.plugin.random_mobility import RandomMobilityConfig, RandomMobilityPlugin
from python.quiet_protocol import Quiet

CASE = Case([(0.0, 0.0, 0.0), (3.3, 1.7, 2.9)], telemetry_interval_s=UPDATE_S, duration_s=30.0, speed_mps=7.3)
WAYPOINTS = [(11.31, 2.17, 5.03), (4.77, 13.9, 8.21), (-6.13, 3.01, 2.29)]


class OnMission(Quiet):
    """Flies a mission, and changes it from time to time."""

    loop: ClassVar[LoopMission]
    interferes: ClassVar[bool] = False

    def initialize(self) -> None:
        self.mission = MissionMobilityPlugin(
            self, MissionMobilityConfiguration(speed=6.1, loop_mission=self.loop, tolerance=0.431)
        )
        self.mission.start_mission(WAYPOINTS)
        self.reports = 0
        self.track()

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        self.reports += 1
        if self.interferes:
            self.interfere()
        self.track()

    def interfere(self) -> None:
        if self.reports == 250:
            self.mission.set_current_waypoint(2)
        elif self.reports == 700 and self.loop is LoopMission.REVERSE:
            self.mission.set_reversed(not self.mission.is_reversed)
        elif self.reports == 1500:
            self.mission.stop_mission()
        elif self.reports == 2100:
            self.provider.send_mobility_command(SetSpeedMobilityCommand(3.7))
            self.mission.start_mission(WAYPOINTS[::-1])

    def track(self) -> None:
        self.provider.tracked_variables["waypoint"] = self.mission.current_waypoint
        self.provider.tracked_variables["reversed"] = self.mission.is_reversed


class Tripping(Quiet):
    """Takes a random trip of 12 s, and then flies to single points."""

    def initialize(self) -> None:
        self.random_mobility = RandomMobilityPlugin(
            self, RandomMobilityConfig(x_range=(-20, 20), tolerance=0.77)
        )
        self.random_mobility.initiate_random_trip()
        self.reports = 0

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        self.reports += 1
        if self.reports == 1200:
            self.random_mobility.finish_random_trip()
        elif self.reports % 400 == 0:
            self.random_mobility.travel_to_random_waypoint()
        self.provider.tracked_variables["target"] = self.random_mobility.current_target


class Geographic(Quiet):
    """Flies to geographic coordinates."""

    def initialize(self) -> None:
        self.provider.send_mobility_command(GotoGeoCoordsMobilityCommand(-0.00013, 0.00007, 21.0))


def orders(*protocols: type[Quiet], case: Case = CASE) -> Counter[str]:
    """Check that both modes agree; return the number of commands of each kind."""
    integrated, prototype = (trace_case(mode, case, *protocols) for mode in ("integrated", "prototype"))
    assert_same(integrated, prototype)
    return Counter(integrated.names())


@pytest.mark.parametrize("interferes", [False, True], ids=["undisturbed", "interfered with"])
@pytest.mark.parametrize("loop", LoopMission)
def test_a_mission(loop: LoopMission, interferes: bool) -> None:
    protocol = type("OnMission", (OnMission,), {"loop": loop, "interferes": interferes})
    waypoints = 6 if loop is LoopMission.NO and not interferes else 10
    assert orders(protocol)["send_mobility_command"] >= waypoints + 2


def test_a_mission_with_telemetry_at_every_tenth_update() -> None:
    protocol = type("OnMission", (OnMission,), {"loop": LoopMission.REVERSE})
    case = Case(CASE.positions, telemetry_interval_s=10 * UPDATE_S, duration_s=60.0)
    assert orders(protocol, case=case)["handle_telemetry"] == 2 * 600


def test_random_trips() -> None:
    assert orders(Tripping)["send_mobility_command"] > 10


def test_geographic_coordinates() -> None:
    assert orders(Geographic)["send_mobility_command"] == 2


def test_a_waypoint_file(tmp_path_factory: pytest.TempPathFactory) -> None:
    file = tmp_path_factory.mktemp("mission") / "waypoints.txt"
    file.write_text("".join(f"{x},{y},{z}\n" for x, y, z in WAYPOINTS))

    class FromFile(OnMission):
        loop = LoopMission.RESTART

        def initialize(self) -> None:
            super().initialize()
            self.mission.start_mission_with_waypoint_file(str(file))

    assert orders(FromFile)["send_mobility_command"] > 10
