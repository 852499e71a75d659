"""The comparison that `make demo` prints."""

import io
from dataclasses import replace

import pytest
from rich.console import Console

from compare import MODES, OUTCOMES, SCENARIOS, collected, comparison, frames_with
from gradysim.scenario import Scenario, load_scenarios


@pytest.fixture(scope="module")
def scenario() -> Scenario:
    pytest.importorskip("gradysim._netsim")
    return load_scenarios(SCENARIOS, "ZigZag5", overrides=["sim-time-limit=120s"])[0]


@pytest.mark.parametrize("mode", MODES)
def test_what_the_ground_station_holds_is_collected(scenario: Scenario, mode: str) -> None:
    result = MODES[mode](scenario)
    station = replace(result.nodes[-1], tracked_variables={"data": 7})
    assert collected(replace(result, nodes=(*result.nodes[:-1], station))) == 7


def test_outcomes_are_those_of_the_ledger(scenario: Scenario) -> None:
    outcomes = MODES["integrated"](scenario).outcomes
    assert [outcome for outcome in OUTCOMES if frames_with(outcome, outcomes) == "-"] == []


def test_acknowledgements_are_not_counted() -> None:
    ledger = {"broadcast": {"noise": 1000}, "unicast": {"noise": 2}, "ack": {"noise": 5}}
    assert frames_with("noise", {"frames": ledger}) == "1,002"


def test_outcomes_that_a_mode_does_not_know_are_a_dash() -> None:
    assert frames_with("noise", {"frames": {"broadcast": {"lost": 1}, "unicast": {"lost": 1}}}) == "-"


def test_the_table_fits_a_narrow_terminal(scenario: Scenario) -> None:
    output = io.StringIO()
    results = {mode: run(scenario) for mode, run in MODES.items()}
    Console(file=output, width=200).print(comparison(scenario, results))
    assert max(len(line.rstrip()) for line in output.getvalue().splitlines()) <= 80
