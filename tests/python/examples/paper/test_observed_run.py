"""Samples of the handler in the paper's experiment."""

import pytest

pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")

from gradysim.scenario import load_scenarios
from observed_run import MODES, SCENARIOS, ObservedRun, observed_run


def run(mode: str, *overrides: str) -> ObservedRun:
    (scenario,) = load_scenarios(SCENARIOS, "ZigZag5", overrides=[*overrides, "sim-time-limit = 10min"])
    return observed_run(scenario, mode)


@pytest.mark.parametrize("mode", MODES)
def test_it_samples_from_the_start_to_the_end_once_a_minute(mode: str) -> None:
    times_s = [sample.time_s for sample in run(mode).samples]
    assert times_s == [60 * minute for minute in range(11)]


@pytest.mark.parametrize("mode", MODES)
def test_the_last_sample_has_what_the_ground_station_has_in_the_result(mode: str) -> None:
    observed = run(mode)
    assert observed.samples[0].readings == 0
    assert observed.samples[-1].readings == observed.result.nodes[-1].tracked_variables["data"] != 0


@pytest.mark.parametrize("mode", MODES)
def test_uavs_begin_one_metre_from_each_other_and_the_second_one_follows_30_s_later(mode: str) -> None:
    first, second = run(mode).samples[:2]
    assert first.nearest_m == pytest.approx(1)
    assert second.nearest_m == pytest.approx(30 * 10, rel=0.01)


@pytest.mark.parametrize("mode", MODES)
def test_the_observer_changes_nothing(mode: str) -> None:
    (scenario,) = load_scenarios(SCENARIOS, "ZigZag5", overrides=["sim-time-limit = 10min"])
    assert MODES[mode](scenario).nodes == run(mode).result.nodes
