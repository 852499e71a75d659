from typing import Any

import pytest

from gradysim.scenario.doubts.mission_speeds import mission_speeds

PROTOCOLS = """
from gradysim.protocol.plugin import mission_mobility
from gradysim.protocol.plugin.mission_mobility import (
    LoopMission,
    MissionMobilityConfiguration,
    MissionMobilityPlugin,
)
from protocols import Sensor


class {name}(Sensor):
    def initialize(self):
        {code}


class Derived({name}):
    pass
"""


def told(
    folder: Any, code: str, line: str = "*.uavs[*].mobility.speed = 12mps", name: str = "Flies"
) -> list[str]:
    folder.write("flies.py", PROTOCOLS.format(code=code, name="Flies"))
    chosen = f'[X]\n*.uavs[*].protocol.class = "flies.py:{name}"\n'
    return list(mission_speeds(folder.load(f"{chosen}{line}\n", "X").nodes))


def test_a_speed_that_a_mission_overrides_by_its_default_is_told_once(folder: Any) -> None:
    (text,) = told(folder, "MissionMobilityPlugin(self)")
    assert text == (
        f"{folder.ini}:8: warning: missions of Flies do not fly at this speed, but at 5 m/s, the default of"
        " MissionMobilityConfiguration; expected `MissionMobilityConfiguration(speed=...)` there"
    )


@pytest.mark.parametrize(
    "code",
    [
        "mission_mobility.MissionMobilityPlugin(protocol=self)",
        "MissionMobilityPlugin(self, MissionMobilityConfiguration(tolerance=3))",
        "MissionMobilityPlugin(self, configuration=MissionMobilityConfiguration())",
    ],
)
def test_ways_to_say_no_speed(folder: Any, code: str) -> None:
    assert len(told(folder, code)) == len(told(folder, code, name="Derived")) == 1


@pytest.mark.parametrize(
    "code",
    [
        "pass",
        "MissionMobilityPlugin(self, MissionMobilityConfiguration(speed=5))",
        "MissionMobilityPlugin(self, MissionMobilityConfiguration(5, LoopMission.NO))",
        "MissionMobilityPlugin(self, self.configuration)",
        "MissionMobilityPlugin(self, MissionMobilityConfiguration(**self.options))",
        "MissionMobilityPlugin(*self.arguments)",
        "c = MissionMobilityConfiguration(); c.speed = 9; MissionMobilityPlugin(self, c)",
        "MissionMobilityPlugin(self, replace(MissionMobilityConfiguration(tolerance=3), speed=9))",
        "MissionMobilityPlugin(self); self.provider.send_mobility_command(SetSpeedMobilityCommand(9))",
    ],
)
def test_a_mission_that_may_say_its_speed_is_not_told(folder: Any, code: str) -> None:
    assert told(folder, code) == []


@pytest.mark.parametrize(
    "line", ["", "*.uavs[*].mobility.speed = 5mps", "*.groundStation.mobility.speed = 12mps"]
)
def test_no_line_or_the_same_speed_is_fine(folder: Any, line: str) -> None:
    assert told(folder, "MissionMobilityPlugin(self)", line) == []
