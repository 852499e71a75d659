"""Tests of the protocols of NAME: `python -m pytest`."""

from pathlib import Path

from gradysim.prototype.run import run as run_prototype
from gradysim.results.result import RunResult
from gradysim.scenario import load_scenarios

SCENARIOS = Path(__file__).parent / "NAME.ini"


def numbers_of(result: RunResult) -> tuple[int, int]:
    """Return how many reports were sent, and how many the station heard."""
    sent = sum(node.tracked_variables.get("reports", 0) for node in result.nodes)
    (station,) = (node for node in result.nodes if node.name == "station")
    return sent, station.tracked_variables["heard"]


def test_the_station_hears_reports() -> None:
    """In prototype mode, where nothing collides."""
    (scenario,) = load_scenarios(SCENARIOS, "Jittered")
    sent, heard = numbers_of(run_prototype(scenario))
    assert sent > 200
    assert heard > 0


def test_every_configuration_can_be_read() -> None:
    """Mistakes in the .ini file are errors, with their lines."""
    for config, runs in (("General", 1), ("Jittered", 1), ("Study", 20)):
        assert len(load_scenarios(SCENARIOS, config)) == runs
