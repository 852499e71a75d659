"""The script that draws the figures of the paper."""

from dataclasses import replace
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")
pytest.importorskip("matplotlib", reason="the pictures need it")

from figures import SIZES, curve, main
from gradysim.scenario import load_scenarios
from observed_run import SCENARIOS, ObservedRun, Sample, observed_run


@pytest.fixture(scope="module")
def observed() -> ObservedRun:
    (scenario,) = load_scenarios(SCENARIOS, "ZigZag5", overrides=["sim-time-limit = 1min"])
    return observed_run((scenario, "integrated"))


def with_readings(observed: ObservedRun, *readings: int) -> ObservedRun:
    samples = (Sample(60.0 * minute, count, 0.0, 0.0) for minute, count in enumerate(readings))
    return replace(observed, samples=tuple(samples))


def test_a_curve_has_the_mean_of_the_runs_and_its_interval(observed: ObservedRun) -> None:
    runs = [with_readings(observed, 0, 10), with_readings(observed, 0, 12), with_readings(observed, 0, 14)]
    points = curve(runs, lambda sample: sample.readings)
    assert points[0] == (0, 0, 0)
    assert points[1] == (60, 12, pytest.approx(4.303 * 2 / 3**0.5, rel=1e-3))  # t of 2 degrees of freedom


def test_a_single_run_has_no_interval(observed: ObservedRun) -> None:
    assert curve([with_readings(observed, 5)], lambda sample: sample.readings) == [(0, 5, 0)]


def test_few_runs_are_drawn_and_printed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["--runs", "2", "--time", "2min", "--jobs", "2", "--output", str(tmp_path / "new")])
    assert sorted(file.name for file in (tmp_path / "new").iterdir()) == ["collected.png", "cost.png"]
    printed = capsys.readouterr().out
    assert "Means of 2 runs" in printed
    assert "at 1 min   at 2 min" in printed
    assert [printed.count(size + " ") for size in SIZES] == [2, 2, 2]
