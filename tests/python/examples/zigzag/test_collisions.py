"""ZigZag on the realistic network: the paper's findings, which prototype mode cannot show.

Twenty minutes of the smallest size; `test_paper_claims.py` has all sizes at full length.
"""

from functools import cache
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")

import gradysim.integrated.run
import gradysim.prototype.run
from gradysim.results.result import RunResult
from gradysim.scenario import load_scenarios

FILE = Path(__file__).parents[4] / "configs" / "zigzag.ini"


@cache
def fly(config: str, mode: str = "integrated") -> RunResult:
    run = {"integrated": gradysim.integrated.run.run, "prototype": gradysim.prototype.run.run}[mode]
    (scenario,) = load_scenarios(FILE, config, overrides=["sim-time-limit = 20min"])
    return run(scenario)


def arrived(result: RunResult) -> int:
    (station,) = (node for node in result.nodes if node.name == "groundStation")
    value = station.tracked_variables["data"]
    assert isinstance(value, int)
    return value


def uavs(result: RunResult, variable: str) -> list[int]:
    values = [node.tracked_variables[variable] for node in result.nodes if node.name.startswith("uavs[")]
    assert all(isinstance(value, int) for value in values)
    return [int(str(value)) for value in values]


def test_when_all_heartbeats_leave_in_the_same_instant_nothing_arrives() -> None:
    assert arrived(fly("ZigZag5Synchronised")) == 0


def test_then_no_uav_ever_hears_another_one_or_the_ground_station() -> None:
    assert set(uavs(fly("ZigZag5Synchronised"), "interactions")) == {0}


def test_then_uavs_still_collect_the_readings_of_sensors() -> None:
    assert min(uavs(fly("ZigZag5Synchronised"), "collected")) > 200


def test_the_ledger_says_why() -> None:
    broadcast = fly("ZigZag5Synchronised").outcomes["frames"]["broadcast"]
    others = [broadcast[outcome] for outcome in ("noise", "interference", "receiver_locked")]
    assert broadcast["receiver_transmitting"] > sum(others)


def test_with_jitter_data_arrives() -> None:
    result = fly("ZigZag5")
    assert arrived(result) > 0.8 * sum(uavs(result, "collected"))


def test_no_reading_exists_twice() -> None:
    result = fly("ZigZag5")
    assert arrived(result) + sum(uavs(result, "data")) <= sum(uavs(result, "collected"))


def test_prototype_mode_collects_more() -> None:
    assert arrived(fly("ZigZag5", mode="prototype")) > arrived(fly("ZigZag5"))
