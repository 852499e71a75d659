"""Quadcopters fly the same path in both modes, and errors of positions are the same."""

import math
from pathlib import Path
from typing import Any

import pytest
from perfect_channel import MODES

from gradysim.integrated.run import IntegratedRun
from gradysim.prototype.run import PrototypeRun
from gradysim.replay import read_replay
from gradysim.replay.sink import ReplayWriter
from gradysim.scenario.errors import ConfigError

TRIP = """
class Tested(Quiet):
    def initialize(self):
        self.told, self.true = [], []
        self.provider.schedule_timer("turn", 8.005)
        self.go(60, 0, 30)
    def go(self, *place):
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(*place))
    def handle_timer(self, timer):
        self.go(20, 40, 0)
    def handle_telemetry(self, telemetry):
        if len(self.told) == 50:
            self.go(60, 30, 30)
        self.told.append(telemetry.current_position)
        self.true.append(self.provider.node_positions()[self.provider.get_id()])
    def finish(self):
        self.provider.tracked_variables["told"] = self.told
        self.provider.tracked_variables["true"] = self.true
"""
QUADCOPTER = ['*.uavs[*].mobility.typename = "QuadcopterMobility"', "*.uavs[*].mobility.initialZ = 20m"]
WIND = ["*.wind.speed = 6mps", "*.wind.heading = 30deg", "*.wind.gusts = 2mps"]
ERROR = ["*.uavs[*].mobility.positionError = 1.5m"]
AIRFRAME = [
    "*.uavs[0].mobility.acceleration = 0.9",
    "*.uavs[0].mobility.drag = 0.8",
    "*.uavs[*].mobility.positionErrorRatio = 1.2",
]
LINES = ["sim-time-limit = 25s", "*.uavs[*].mobility.telemetryInterval = 0.1s", *QUADCOPTER]


def tracks(result: Any, name: str) -> list[Any]:
    return [node.tracked_variables[name] for node in result.nodes]


@pytest.mark.parametrize("effects", [(), WIND, ERROR, (*WIND, *ERROR), (*WIND, *ERROR, *AIRFRAME)])
def test_both_modes_fly_the_same_path(make_scenario: Any, effects: list[str]) -> None:
    scenario = make_scenario(TRIP, *LINES, *effects)
    integrated, prototype = (MODES[mode](scenario) for mode in ("integrated", "prototype"))
    for name in ("told", "true"):
        for one, other in zip(tracks(integrated, name), tracks(prototype, name), strict=True):
            assert len(one) == len(other) == 250
            assert max(map(math.dist, one, other)) < 1e-9
    assert [node.position for node in integrated.nodes] == [node.position for node in prototype.nodes]


@pytest.mark.parametrize("mode", MODES)
def test_a_run_is_repeatable(make_scenario: Any, mode: str) -> None:
    scenario = make_scenario(TRIP, *LINES, *WIND, *ERROR)
    assert tracks(MODES[mode](scenario), "told") == tracks(MODES[mode](scenario), "told")


@pytest.mark.parametrize("mode", MODES)
def test_errors_of_positions_depend_on_no_other_effect(make_scenario: Any, mode: str) -> None:
    errors = []
    for effects in ((), WIND, ('*.uavs[*].mobility.typename = "MasslessMobility"',)):
        (told, *_), (true, *_) = (
            tracks(MODES[mode](make_scenario(TRIP, *effects, *LINES, *ERROR)), name)
            for name in ("told", "true")
        )
        errors.append([x - true_x for (x, _, _), (true_x, _, _) in zip(told, true, strict=True)])
    assert errors[0] == pytest.approx(errors[1], abs=1e-9)
    assert errors[0] == pytest.approx(errors[2], abs=1e-9)


@pytest.mark.parametrize("run", [IntegratedRun, PrototypeRun])
def test_replays_show_the_true_path(make_scenario: Any, run: Any, tmp_path: Path) -> None:
    recorded = run(make_scenario(TRIP, *LINES, *ERROR), replay=ReplayWriter(tmp_path / "run.html"))
    recorded.execute()
    true = recorded.result().nodes[1].tracked_variables["true"]
    replay = read_replay(tmp_path / "run.html")
    for number in range(20, 240, 10):
        assert math.dist(replay.positions(0.1 * (number + 1))[1], true[number]) < 0.3


def test_a_start_below_the_ground_is_refused(make_scenario: Any) -> None:
    with pytest.raises(ConfigError, match=r"z = -1m; .* 0m"):
        make_scenario(TRIP, *QUADCOPTER[:1], "*.uavs[*].mobility.initialZ = -1m")
