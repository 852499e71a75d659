"""Behavior of configs/sensor_field.ini."""

from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

import gradysim.prototype.run
from gradysim.integrated.run import run
from gradysim.results.result import RunResult
from gradysim.scenario import load_scenarios

FILE = Path(__file__).parents[4] / "configs" / "sensor_field.ini"
SENSORS = 20


def result_of(config: str, *overrides: str) -> RunResult:
    (scenario,) = load_scenarios(FILE, config, overrides=["sim-time-limit = 60s", *overrides])
    return run(scenario)


def ground_station(result: RunResult) -> dict[str, object]:
    (node,) = [node for node in result.nodes if node.name == "groundStation"]
    return dict(node.tracked_variables)


@pytest.mark.parametrize("config", ["Spread", "WithUavs"])
def test_nearly_all_spread_reports_arrive(config: str) -> None:
    result = result_of(config)
    messages = result.outcomes["messages"]["unicast"]
    assert sum(messages.values()) >= SENSORS * 6
    assert ground_station(result)["sensors_heard"] == SENSORS
    assert messages["acknowledged"] >= 0.99 * sum(messages.values())


def test_scattered_sensors_are_elsewhere_in_each_run() -> None:
    scenarios = load_scenarios(FILE, "Scattered")
    places = {node.initial_position for scenario in scenarios for node in scenario.nodes}
    assert len(places) == len(scenarios) * SENSORS + 1
    assert all(-30 <= x <= 30 and -30 <= y <= 30 for x, y, _ in places)


def test_scattered_reports_arrive() -> None:
    (scenario, *_) = load_scenarios(FILE, "Scattered", overrides=["sim-time-limit = 60s"])
    assert ground_station(run(scenario))["sensors_heard"] == SENSORS


def test_synchronised_sensors_find_the_channel_busy() -> None:
    messages = result_of("Synchronised").outcomes["messages"]["unicast"]
    assert messages["channel_access_failure"] > 0.1 * sum(messages.values())


def test_where_the_spectrum_is_shared_reports_are_disturbed() -> None:
    lost = [
        result_of("SharedSpectrum", *overrides).outcomes["frames"]["unicast"]["interference"]
        for overrides in ((), ("*.uavs[*].wlan[*].radio.centerFrequency = 2.412GHz",))
    ]
    assert lost[0] >= 5
    assert lost[1] == 0


def test_the_gateway_hands_every_report_on() -> None:
    result = result_of("Gateway")
    assert ground_station(result)["sensors_heard"] == SENSORS
    messages = result.outcomes["messages"]["unicast"]
    assert messages["acknowledged"] >= 0.99 * sum(messages.values()) >= 2 * SENSORS * 6 * 0.99


def test_a_report_that_is_too_long_is_refused() -> None:
    with pytest.raises(Exception, match=r" 91 .* 90 "):
        result_of("Spread", "*.sensors[*].protocol.payload_bytes = 91")


@pytest.mark.parametrize("config", ["Spread", "Gateway"])
def test_it_runs_in_prototype_mode(config: str) -> None:
    overrides = ["sim-time-limit = 60s", "*.communicationMedium.transmissionRange = 100m"]
    (scenario,) = load_scenarios(FILE, config, overrides=overrides)
    result = gradysim.prototype.run.run(scenario)
    assert ground_station(result)["sensors_heard"] == SENSORS
