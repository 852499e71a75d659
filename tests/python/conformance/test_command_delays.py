"""The time from a command until the vehicle obeys: both modes fly the same path, later."""

import math
from pathlib import Path
from typing import Any

import pytest
from perfect_channel import MODES

from gradysim.integrated.run import IntegratedRun
from gradysim.protocol.errors import MasslessMobilityException
from gradysim.prototype.run import PrototypeRun
from gradysim.replay import read_replay
from gradysim.replay.sink import ReplayWriter

TRIP = """
from gradysim.protocol.messages.mobility import SetSpeedMobilityCommand

class Tested(Quiet):
    def initialize(self):
        self.places = []
        self.go(60, 0, 30)
        self.provider.schedule_timer("turn", 4.005)
    def go(self, *place):
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(*place))
    def handle_timer(self, timer):
        self.go(0, 0, 30)
        self.provider.send_mobility_command(SetSpeedMobilityCommand(3))
        self.go(60, 40, 30)
    def handle_telemetry(self, telemetry):
        self.places.append(telemetry.current_position)
    def finish(self):
        self.provider.tracked_variables["places"] = self.places
"""
MASSLESS, QUADCOPTER = "MasslessMobility", "QuadcopterMobility"


def lines(typename: str, delay: str) -> tuple[str, ...]:
    return (
        "sim-time-limit = 12s",
        f'*.uavs[*].mobility.typename = "{typename}"',
        f"*.uavs[*].mobility.commandDelay = {delay}",
        "*.uavs[*].mobility.initialZ = 30m",
        "*.uavs[*].mobility.telemetryInterval = 0.01s",
    )


def places(result: Any) -> list[Any]:
    found: list[Any] = result.nodes[1].tracked_variables["places"]
    return found


@pytest.mark.parametrize("typename", [MASSLESS, QUADCOPTER])
@pytest.mark.parametrize("delay", ["0.65s", "0.003s"])
def test_both_modes_fly_the_same_path(make_scenario: Any, typename: str, delay: str) -> None:
    scenario = make_scenario(TRIP, *lines(typename, delay))
    integrated, prototype = (places(MODES[mode](scenario)) for mode in ("integrated", "prototype"))
    assert len(integrated) == len(prototype)
    # A massless vehicle of prototype mode turns up to one update of 10 ms too early.
    most_m = 0.1 if typename == MASSLESS else 0.0
    assert max(map(math.dist, integrated, prototype)) <= most_m


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("typename", [MASSLESS, QUADCOPTER])
def test_it_is_the_path_without_a_delay_but_later(make_scenario: Any, mode: str, typename: str) -> None:
    at_once, later = (
        places(MODES[mode](make_scenario(TRIP, *lines(typename, delay)))) for delay in ("0s", "0.5s")
    )
    assert max(math.dist(place, at_once[0]) for place in later[:50]) < 0.1
    assert max(map(math.dist, at_once[:-50], later[50:])) < 1e-9
    assert later[-1][1] > 1  # the last command of the timer is in force


@pytest.mark.parametrize("mode", MODES)
def test_a_wrong_command_is_refused_at_once(make_scenario: Any, mode: str) -> None:
    wrong = """
class Tested(Quiet):
    def initialize(self):
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(float("inf"), 0, 0))
"""
    scenario = make_scenario(wrong, *lines(MASSLESS, "1s"))
    with pytest.raises(MasslessMobilityException) as error:
        MODES[mode](scenario)
    assert any("initialize" in note for note in error.value.__notes__)


@pytest.mark.parametrize("run_class", [IntegratedRun, PrototypeRun])
def test_a_replay_shows_when_it_obeys(make_scenario: Any, run_class: Any, tmp_path: Path) -> None:
    recorded = run_class(
        make_scenario(TRIP, *lines(MASSLESS, "0.5s")), replay=ReplayWriter(tmp_path / "run.html")
    )
    recorded.execute()
    replay = read_replay(tmp_path / "run.html")
    true = places(recorded.result())
    for time_s in (0.4, 1.0, 3.0, 4.4, 6.0, 11.0):
        assert math.dist(replay.positions(time_s)[1], true[round(time_s * 100) - 1]) < 0.3
    events = replay.table("events")
    commands = [t for t, text in zip(events["time_ns"], events["text"], strict=True) if "fly at" in str(text)]
    assert set(commands) == {4_005_000_000}
