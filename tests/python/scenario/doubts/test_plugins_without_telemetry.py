from typing import Any

import pytest

from gradysim.scenario.doubts.plugins_without_telemetry import plugins_without_telemetry

PROTOCOLS = """
from gradysim.protocol.plugin import random_mobility
from gradysim.protocol.plugin.mission_mobility import MissionMobilityPlugin
from gradysim.protocol.plugin.random_mobility import RandomMobilityPlugin
from protocols import Sensor


class Flies(Sensor):
    def initialize(self):
        {code}


class Derived(Flies):
    pass
"""

MISSION = "self.mission = MissionMobilityPlugin(self); self.mission.start_mission([(0, 0, 9), (9, 0, 9)])"
TRIP = "self.trip = RandomMobilityPlugin(self); self.trip.initiate_random_trip()"


def told(folder: Any, code: str, line: str = "**.telemetryInterval = 0s", name: str = "Flies") -> list[str]:
    folder.write("flies.py", PROTOCOLS.format(code=code))
    chosen = f'[X]\n*.uavs[*].protocol.class = "flies.py:{name}"\n'
    return list(plugins_without_telemetry(folder.load(f"{chosen}{line}\n", "X").nodes))


@pytest.mark.parametrize(
    ("code", "plugin"), [(MISSION, "MissionMobilityPlugin"), (TRIP, "RandomMobilityPlugin")]
)
def test_a_plugin_that_would_wait_for_ever_is_told_once(folder: Any, code: str, plugin: str) -> None:
    (text,) = told(folder, code)
    assert text == (
        f"{folder.ini}:8: warning: uavs will not get beyond the first waypoint, as the {plugin} of Flies goes"
        " on by telemetry, and 0s is none; expected an interval such as 10ms"
    )


def test_plugins_of_bases_and_by_the_names_of_their_modules_count(folder: Any) -> None:
    code = "random_mobility.RandomMobilityPlugin(protocol=self).initiate_random_trip()"
    (text,) = told(folder, code, name="Derived")
    assert "RandomMobilityPlugin of Derived goes on" in text


def test_each_group_that_a_line_stops_is_told(folder: Any) -> None:
    line = '*.groundStation.protocol.class = "flies.py:Derived"\n**.telemetryInterval = 0s'
    assert len(told(folder, MISSION, line)) == 2


@pytest.mark.parametrize(
    "code",
    [
        "pass",
        "RandomMobilityPlugin(self).travel_to_random_waypoint()",
        f"{MISSION}; self.next = lambda: self.mission.set_current_waypoint(1)",
    ],
)
def test_who_does_without_telemetry_is_not_told(folder: Any, code: str) -> None:
    assert told(folder, code) == []


@pytest.mark.parametrize(
    "line",
    [
        "",
        "**.telemetryInterval = 1s",
        "*.groundStation.mobility.telemetryInterval = 0s",
        '**.telemetryInterval = 0s\n*.uavs[*].mobility.typename = "StationaryMobility"',
    ],
)
def test_telemetry_of_any_interval_is_fine_and_none_for_who_stands(folder: Any, line: str) -> None:
    assert told(folder, MISSION, line) == []
