"""The paper's findings with ZigZag, each at its full length of two simulated hours.

T. Lamenza et al., "Developing Algorithms for the Internet of Flying Things Through Environments With Varying
Degrees of Realism", section "Results and Discussions": heartbeats that all start at the same instant work in
the prototype and fail on a real channel. With a random delay they work on both, and the prototype collects
more. The tests do not check the paper's numbers: its radios were tuned for another simulator.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")

import gradysim.prototype.run
from gradysim.integrated.run import run
from gradysim.results.result import RunResult
from gradysim.scenario import load_scenarios

pytestmark = pytest.mark.verify

FILE = Path(__file__).parents[4] / "configs" / "zigzag.ini"
SIZES = ["ZigZag5", "ZigZag15", "ZigZag25"]
WITH_JITTER = [("ZigZag5", 0), ("ZigZag5", 1), ("ZigZag5", 2), ("ZigZag15", 0), ("ZigZag25", 0)]


@dataclass(frozen=True)
class Flight:
    """A run in integrated mode, with the outcomes of receptions at the ground station.

    Attributes:
        heard: Receptions strong enough there: {kind: {outcome: count}}.
    """

    result: RunResult
    heard: Mapping[str, Mapping[str, int]]


@cache
def integrated(config: str, seed: int = 0) -> Flight:
    (scenario,) = load_scenarios(FILE, config, overrides=[f"seed-set = {seed}"])
    result = run(scenario, outcomes_at=[scenario.nodes[-1].id])
    heard = result.nodes[-1].frame_outcomes
    assert heard is not None
    return Flight(result, heard)


@cache
def prototype(config: str, seed: int = 0) -> RunResult:
    (scenario,) = load_scenarios(FILE, config, overrides=[f"seed-set = {seed}"])
    return gradysim.prototype.run.run(scenario)


def arrived(result: RunResult) -> int:
    """Return the number of readings that reached the ground station."""
    assert result.nodes[-1].name == "groundStation"
    assert (result.sim_time_s, result.interrupted) == (7200.0, False)
    count = result.nodes[-1].tracked_variables["data"]
    assert isinstance(count, int)
    return count


def uavs(result: RunResult, variable: str) -> list[int]:
    values = [node.tracked_variables[variable] for node in result.nodes if node.name.startswith("uavs[")]
    assert all(isinstance(value, int) for value in values)
    return [int(str(value)) for value in values]


@pytest.mark.parametrize("size", SIZES)
def test_synchronised_heartbeats_bring_nothing_to_the_ground_station(size: str) -> None:
    assert arrived(integrated(f"{size}Synchronised").result) == 0


def test_synchronised_heartbeats_work_in_the_prototype() -> None:
    assert arrived(prototype("ZigZag5Synchronised")) > 0


@pytest.mark.parametrize("size", SIZES)
def test_then_no_uav_ever_hears_another_one_or_the_ground_station(size: str) -> None:
    assert set(uavs(integrated(f"{size}Synchronised").result, "interactions")) == {0}


@pytest.mark.parametrize("size", SIZES)
def test_every_heartbeat_that_reaches_the_ground_station_meets_its_own_transmission(size: str) -> None:
    heard = integrated(f"{size}Synchronised").heard["broadcast"]
    assert heard.keys() == {"receiver_transmitting"}


@pytest.mark.parametrize("size", SIZES)
def test_heartbeats_did_reach_the_ground_station(size: str) -> None:
    assert sum(integrated(f"{size}Synchronised").heard["broadcast"].values()) > 100


@pytest.mark.parametrize("size", SIZES)
def test_nobody_gets_as_far_as_sending_the_ground_station_a_message(size: str) -> None:
    assert "unicast" not in integrated(f"{size}Synchronised").heard


@pytest.mark.parametrize("outcome", ["receiver_transmitting", "interference"])
def test_the_ledger_of_the_whole_network_says_why(outcome: str) -> None:
    assert integrated("ZigZag5Synchronised").result.outcomes["frames"]["broadcast"][outcome] > 0


@pytest.mark.parametrize("size", SIZES)
def test_with_jitter_the_ground_station_receives_heartbeats(size: str) -> None:
    assert integrated(size).heard["broadcast"]["delivered"] > 0


@pytest.mark.parametrize(("size", "seed"), WITH_JITTER)
def test_with_jitter_data_arrives(size: str, seed: int) -> None:
    result = integrated(size, seed).result
    assert arrived(result) > 0.8 * sum(uavs(result, "collected"))


@pytest.mark.parametrize(("size", "seed"), WITH_JITTER)
def test_with_jitter_the_prototype_collects_more(size: str, seed: int) -> None:
    assert arrived(prototype(size, seed)) > arrived(integrated(size, seed).result)
