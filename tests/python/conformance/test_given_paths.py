"""Nodes on given paths are at the same places in both modes, in telemetry and in replays."""

import math
from pathlib import Path
from typing import Any

import pytest
from perfect_channel import MODES

from gradysim.integrated.run import IntegratedRun
from gradysim.prototype.run import PrototypeRun
from gradysim.replay import read_replay
from gradysim.replay.sink import ReplayWriter

PATHS = {
    "LinearMobility": ["initialMovementHeading = 33deg", "initialMovementElevation = 7deg"],
    "CircleMobility": ["cx = 20m", "cy = 10m", "cz = 5m", "r = 15m", "startAngle = 45deg"],
    "RectangleMobility": ["startPos = 2.5", "initialZ = 3m"],
}

AREA = [
    f"constraintArea{end} = {value}m"
    for end, value in (("MinX", 0), ("MaxX", 40), ("MinY", 0), ("MaxY", 20), ("MinZ", 0), ("MaxZ", 9))
]

PLACES = """
class Tested(Quiet):
    def initialize(self): self.places = []
    def handle_telemetry(self, telemetry): self.places.append(telemetry.current_position)
    def finish(self): self.provider.tracked_variables["places"] = self.places
"""

ORDERS = """
class Tested(Quiet):
    def initialize(self): self.provider.send_mobility_command(GotoCoordsMobilityCommand(0, 0, 0))
"""


@pytest.fixture(params=PATHS)
def path(request: pytest.FixtureRequest) -> list[str]:
    lines = [f'typename = "{request.param}"', *PATHS[request.param], *AREA, "speed = 7mps"]
    return ["sim-time-limit = 60s", *(f"*.uavs[*].mobility.{line}" for line in lines)]


def test_telemetry(make_scenario: Any, path: list[str]) -> None:
    scenario = make_scenario(PLACES, *path, "*.uavs[*].mobility.telemetryInterval = 0.37s")
    integrated, prototype = (
        MODES[mode](scenario).nodes[1].tracked_variables["places"] for mode in ("integrated", "prototype")
    )
    assert len(integrated) == len(prototype) == 162
    assert len(set(integrated)) > 100
    assert max(map(math.dist, integrated, prototype)) < 1e-9


@pytest.mark.parametrize("run", [IntegratedRun, PrototypeRun])
def test_replays_show_the_path(make_scenario: Any, path: list[str], run: Any, tmp_path: Path) -> None:
    scenario = make_scenario(PLACES, *path)
    recorded = run(scenario, replay=ReplayWriter(tmp_path / "run.html"))
    recorded.execute()
    places = recorded.result().nodes[1].tracked_variables["places"]
    replay = read_replay(tmp_path / "run.html")
    for number in range(20, 118):
        shown = replay.positions(0.5 * (number + 1))[1]
        assert math.dist(shown, places[number]) < 0.75  # prototype mode samples: it cuts corners


@pytest.mark.parametrize("mode", MODES)
def test_commands_are_refused(make_scenario: Any, path: list[str], mode: str) -> None:
    with pytest.raises(Exception, match=r"node 0 .* GotoCoords"):
        MODES[mode](make_scenario(ORDERS, *path))
