from pathlib import Path

import pytest

from gradysim.plots.numbers import Curve, label_of, number_of_runs, series_of, x_axis
from gradysim.results import Runs, runs
from gradysim.scenario.errors import ConfigError
from python.study_files import write_result


def study_of(directory: Path, *iterations: dict[str, object]) -> Runs:
    for run, values in enumerate(iterations):
        write_result(directory, run, iterations=values)
    return runs(directory)


@pytest.mark.parametrize(
    ("values", "label", "positions"),
    [
        ([20, 5, 10.5], "v", [5, 10.5, 20]),
        (["10ms", "2ms"], "v (ms)", [2, 10]),
        (["1s", "100ms"], "v (s)", [0.1, 1]),
        (["-90dBm", "-100dBm"], "v (dBm)", [-100, -90]),
        (["0dBm", "1mW"], "v (W)", [0.001, 0.001]),
        (["fast", "10ms"], "v", ["fast", "10ms"]),
        (["10m", "10ms"], "v", ["10m", "10ms"]),
        ([5, "10ms"], "v", ["5", "10ms"]),
    ],
)
def test_values_of_an_axis(tmp_path: Path, values: list[object], label: str, positions: list[object]) -> None:
    axis = x_axis(study_of(tmp_path, *({"v": value} for value in values)), "v")
    assert axis.label == label
    assert list(axis.positions.values()) == pytest.approx(positions)
    assert axis.categories == (tuple(positions) if isinstance(positions[0], str) else ())


def test_an_unknown_variable(tmp_path: Path) -> None:
    with pytest.raises(ConfigError) as raised:
        x_axis(study_of(tmp_path, {"jitter": 1}), "jiter")
    assert raised.value.suggestion == "jitter"


def test_a_curve_for_all_variables_that_differ(tmp_path: Path) -> None:
    study = study_of(tmp_path, *({"x": x, "y": y, "z": 1} for x in (1, 2) for y in ("a", "b")))
    found = series_of(study, None, "x")
    assert [(values, len(alike)) for values, alike in found] == [({"y": "a"}, 2), ({"y": "b"}, 2)]


def test_a_variable_in_lock_step_with_the_axis_makes_no_curve(tmp_path: Path) -> None:
    study = study_of(tmp_path, {"x": 1, "y": "a"}, {"x": 2, "y": "b"})
    assert [values for values, _ in series_of(study, None, "x")] == [{}]


def test_runs_that_differ_in_more_than_is_said_are_not_mixed(tmp_path: Path) -> None:
    study = study_of(tmp_path, *({"x": x, "y": y, "z": z} for x in (1, 2) for y in "ab" for z in "cd"))
    with pytest.raises(ConfigError) as raised:
        series_of(study, ["y"], "x")
    assert "--by y z" in raised.value.expected
    assert len(series_of(study, ["y", "z"], "x")) == 4


def test_labels_of_curves() -> None:
    curve = Curve({"config": "Big", "mode": "prototype", "run": 3, "jitter": "1ms"}, {})
    assert curve.label == "Big, prototype, run = 3, jitter = 1ms"


@pytest.mark.parametrize(
    ("quantity", "label"),
    [
        ("cpu_s", "processor time (s)"),
        ("events", "events"),
        ("unicast messages delay in s", "unicast messages delay (s)"),
        ("uavs[*] heard", "uavs[*] heard"),
    ],
)
def test_labels_of_quantities(quantity: str, label: str) -> None:
    assert label_of(quantity) == label


def test_numbers_of_runs() -> None:
    assert number_of_runs([10, 10]) == "n = 10 runs"
    assert number_of_runs([1], "pair") == "n = 1 pair"
    assert number_of_runs([8, 10, 9]) == "n = 8 to 10 runs"
