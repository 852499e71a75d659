import math
from pathlib import Path

import pytest
from matplotlib.axes import Axes

from gradysim import plots
from gradysim.plots.numbers import Curve
from gradysim.plots.time import time_numbers
from gradysim.results import Estimate, estimate, runs
from gradysim.scenario.errors import ConfigError
from python.study_files import write_result, write_vectors

HEARD = "uavs[*] heard"


def heard(node: int) -> tuple[str, str, str]:
    return f"uavs[{node}]", "protocol", "heard"


def at(curve: Curve, time: float) -> tuple[Estimate, int]:
    index = list(curve.x).index(time)
    mean, low, high, count = (curve.columns[name][index] for name in ("mean", "low", "high", "runs"))
    return Estimate(mean, low, high), count


def test_the_mean_of_the_nodes_and_of_the_runs_at_each_time(tmp_path: Path) -> None:
    write_vectors(write_result(tmp_path, 0), {heard(0): {0: 0, 5: 10}, heard(1): {0: 2}})
    write_vectors(write_result(tmp_path, 1), {heard(0): {0: 4}})
    (curve,) = time_numbers(runs(tmp_path), y=HEARD).curves
    assert next(iter(curve.columns)) == "time (s)"
    assert (curve.x[0], curve.x[-1]) == (0, 10)
    for time, of_runs in ((0, [1, 4]), (5, [6, 4]), (10, [6, 4])):
        assert at(curve, time) == (estimate(of_runs), 2)


def test_the_probability_of_an_event_over_time_has_exact_intervals(tmp_path: Path) -> None:
    write_vectors(write_result(tmp_path, 0), {heard(0): {0: 0, 5: 1}})
    write_vectors(write_result(tmp_path, 1), {heard(0): {0: 0}})
    (curve,) = time_numbers(runs(tmp_path), y=HEARD).curves
    for time, of_runs in ((0, [0, 0]), (5, [1, 0])):
        assert at(curve, time) == (estimate(of_runs, binary=True), 2)


def test_before_the_first_number_there_is_no_point(tmp_path: Path) -> None:
    write_vectors(write_result(tmp_path, 0), {heard(0): {5: 1, 7.5: math.nan}})
    (curve,) = time_numbers(runs(tmp_path), y=HEARD).curves
    assert curve.x[0] == 5
    assert curve.x[-1] < 7.5


@pytest.mark.parametrize(("sim_time_s", "end", "unit"), [(599, 599, "s"), (600, 10, "min"), (36000, 10, "h")])
def test_the_unit_of_time(tmp_path: Path, sim_time_s: float, end: float, unit: str) -> None:
    write_vectors(write_result(tmp_path, 0, sim_time_s=sim_time_s), {heard(0): {0: 1}})
    numbers = time_numbers(runs(tmp_path), y=HEARD)
    assert numbers.x_label == f"time ({unit})"
    assert numbers.curves[0].x[-1] == end


def test_only_the_nodes_of_the_group(tmp_path: Path) -> None:
    file = write_result(tmp_path, nodes=[{"name": n, "tracked_variables": {}} for n in ("base", "uavs[0]")])
    write_vectors(file, {("base", "protocol", "heard"): {0: 9}, heard(0): {0: 1}})
    (curve,) = time_numbers(runs(tmp_path), y="base heard").curves
    assert set(curve.columns["mean"]) == {9}


def test_a_variable_that_was_not_recorded(tmp_path: Path) -> None:
    write_vectors(write_result(tmp_path), {heard(0): {0: 1}})
    with pytest.raises(ConfigError) as raised:
        time_numbers(runs(tmp_path), y="uavs[*] herd")
    assert raised.value.suggestion == HEARD


def test_runs_without_vectors(tmp_path: Path) -> None:
    write_result(tmp_path)
    with pytest.raises(ConfigError) as raised:
        time_numbers(runs(tmp_path), y=HEARD)
    assert "--vectors" in raised.value.expected


def test_what_is_drawn(axes: Axes, tmp_path: Path) -> None:
    for run in range(2):
        write_vectors(write_result(tmp_path, run), {heard(0): {0: 2 * run}})
    assert plots.time(axes, runs(tmp_path), y=HEARD) is axes
    assert set(axes.lines[0].get_ydata()) == {1}
    (band,) = axes.collections
    assert band.get_datalim(axes.transData).height == pytest.approx(2 * 12.706, rel=1e-3)
