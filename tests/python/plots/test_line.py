from pathlib import Path

import pytest
from matplotlib.axes import Axes

from gradysim import plots
from gradysim.plots.line import diff_numbers, line_numbers
from gradysim.results import Runs, compare_pairs, estimate, runs
from gradysim.scenario.errors import ConfigError
from python.study_files import write_result

HEARD = "uavs[*] heard"


def test_means_and_intervals_are_those_of_the_runs(study: Runs) -> None:
    integrated, prototype = line_numbers(study, x="jitter", y=HEARD).curves
    of_1ms, of_2ms = estimate([11, 12, 13]), estimate([20, 20, 21])
    assert integrated.values == {"mode": "integrated"}
    assert integrated.columns == {
        "jitter (ms)": [1, 2],
        "runs": [3, 3],
        "mean": [of_1ms.mean, of_2ms.mean],
        "low": [of_1ms.low, of_2ms.low],
        "high": [of_1ms.high, of_2ms.high],
    }
    assert prototype.columns["mean"] == [10, 20]


def test_what_is_drawn(axes: Axes, study: Runs) -> None:
    assert plots.line(axes, study, x="jitter", y=HEARD) is axes
    points, _, (bars,) = axes.containers[0]
    assert points.get_xydata().tolist() == [[1, 12], [2, pytest.approx(61 / 3)]]
    low, high = bars.get_segments()[0][:, 1]
    assert (high - low) / 2 == pytest.approx(4.303 / 3**0.5, rel=1e-3)  # t of 2 degrees of freedom
    assert axes.get_xlabel() == "jitter (ms)"
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["integrated", "prototype"]
    assert axes.get_title(loc="right") == "mean, 95 % interval, n = 3 runs"


@pytest.mark.parametrize(
    ("values", "ticks"),
    [
        ((2, 5, 10, 20), ["2", "5", "10", "20"]),
        (("100us", "1ms", "10ms"), ["0.0001", "0.001", "0.01"]),
    ],
)
def test_few_values_are_the_ticks(
    axes: Axes, tmp_path: Path, values: tuple[object, ...], ticks: list[str]
) -> None:
    for run, value in enumerate(values):
        write_result(tmp_path, run, (1,), iterations={"x": value})
    plots.line(axes, runs(tmp_path), x="x", y=HEARD)
    assert [label.get_text() for label in axes.get_xticklabels()] == ticks


def test_many_values_have_whole_numbers_as_ticks(axes: Axes, tmp_path: Path) -> None:
    for run in range(4):
        write_result(tmp_path, run, (1,), iterations={"x": 1 if run == 0 else 10**run})
    plots.line(axes, runs(tmp_path), x="x", y=HEARD)
    assert all(float(place).is_integer() for place in axes.get_xticks())


def test_curves_stand_side_by_side_in_categories(axes: Axes, study: Runs) -> None:
    plots.line(axes, study, x="mode", y=HEARD)
    assert [label.get_text() for label in axes.get_xticklabels()] == ["integrated", "prototype"]
    places = [container[0].get_xdata().tolist() for container in axes.containers]
    assert places == [[-0.125, 0.875], [0.125, 1.125]]
    assert axes.containers[0][0].get_linestyle() == "None"
    assert axes.get_xlim() == (-0.5, 1.5)


def test_a_value_that_only_some_runs_have(tmp_path: Path) -> None:
    for run, heard in enumerate((1, "text", 5)):
        write_result(tmp_path, run, (heard,), iterations={"x": run})
    (curve,) = line_numbers(runs(tmp_path), x="x", y=HEARD).curves
    nothing = [None, None]
    assert curve.columns == {"x": [0, 2], "runs": [1, 1], "mean": [1, 5], "low": nothing, "high": nothing}


@pytest.mark.parametrize(("later", "binary"), [((1, 1), True), ((1, 2), False)])
def test_intervals_are_those_of_an_event_if_all_runs_have_0_or_1(
    axes: Axes, tmp_path: Path, later: tuple[int, int], binary: bool
) -> None:
    for run, heard in enumerate((0, 0, *later)):
        write_result(tmp_path, run, (heard,), iterations={"x": run // 2})
    (curve,) = line_numbers(runs(tmp_path), x="x", y=HEARD).curves
    found = [estimate([0, 0], binary=binary), estimate(later, binary=binary)]
    assert curve.columns["high"] == [each.high for each in found]
    plots.line(axes, runs(tmp_path), x="x", y=HEARD)
    (segments,) = axes.containers[0][2]
    drawn = [segment[:, 1].tolist() for segment in segments.get_segments()]
    assert drawn == [pytest.approx([each.low, each.high]) for each in found]


def test_an_unknown_quantity(study: Runs) -> None:
    with pytest.raises(ConfigError) as raised:
        line_numbers(study, x="jitter", y="uavs heard")
    assert raised.value.suggestion == HEARD


def test_differences_are_those_between_runs_of_the_same_seed(study: Runs) -> None:
    (curve,) = diff_numbers(study, x="jitter", y=HEARD, by=["mode"], baseline="prototype").curves
    of_1ms, of_2ms = estimate([1, 2, 3]), estimate([0, 0, 1])
    assert curve.values == {"mode": "integrated - prototype"}
    assert curve.columns == {
        "jitter (ms)": [1, 2],
        "mean": [of_1ms.mean, of_2ms.mean],
        "low": [of_1ms.low, of_2ms.low],
        "high": [of_1ms.high, of_2ms.high],
        "pairs": [3, 3],
        "higher": [3, 1],
    }


def test_differences_of_an_event_are_not_certain(tmp_path: Path) -> None:
    for mode in ("integrated", "prototype"):
        for seed in range(3):
            write_result(tmp_path, seed, (1,), mode=mode, seed=seed, iterations={"x": 1})
    (curve,) = diff_numbers(runs(tmp_path), x="x", y=HEARD).curves
    assert curve.columns["high"] == [compare_pairs([1] * 3, [1] * 3, binary=True).difference.high]


def test_the_first_value_is_the_baseline_by_default(study: Runs) -> None:
    (curve,) = diff_numbers(study, x="jitter", y=HEARD).curves
    assert curve.values == {"mode": "prototype - integrated"}
    assert curve.columns["mean"] == [-2, pytest.approx(-1 / 3)]


def test_other_variables_make_curves(study: Runs) -> None:
    curves = diff_numbers(study, x="config", y=HEARD, by=["mode", "jitter"]).curves
    assert [curve.values["jitter"] for curve in curves] == ["1ms", "2ms"]
    assert [curve.columns["mean"] for curve in curves] == [[-2], [pytest.approx(-1 / 3)]]


def test_what_is_drawn_of_differences(axes: Axes, study: Runs) -> None:
    plots.diff(axes, study, x="jitter", y=HEARD, baseline="prototype")
    assert [text.get_text() for text in axes.texts] == ["3/3", "1/3"]
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["integrated - prototype"]
    assert "n = 3 pairs" in axes.get_title(loc="right")


def test_a_baseline_that_no_run_has(study: Runs) -> None:
    with pytest.raises(ConfigError) as raised:
        diff_numbers(study, x="jitter", y=HEARD, baseline="protoype")
    assert raised.value.suggestion == "prototype"


def test_nothing_to_compare(study: Runs) -> None:
    with pytest.raises(ConfigError):
        diff_numbers(study.where(mode="prototype"), x="jitter", y=HEARD)


def test_runs_of_different_seeds_are_not_compared(tmp_path: Path) -> None:
    write_result(tmp_path, 0, iterations={"x": 1})
    write_result(tmp_path, 1, iterations={"x": 2})
    with pytest.raises(ConfigError) as raised:
        diff_numbers(runs(tmp_path), x="config", y=HEARD)
    assert "seed-set" in raised.value.expected
