from collections.abc import Mapping

import pytest
from matplotlib.axes import Axes

from gradysim.plots.compare import changes_numbers, draw_changes
from gradysim.results.compare import Change
from gradysim.results.paired import Estimate
from gradysim.scenario.errors import ConfigError


def change(quantity: str, first: float, difference: float, values: Mapping[str, object]) -> Change:
    return Change(
        {"mode": "integrated", **values},
        quantity,
        5,
        Estimate(first),
        Estimate(first + difference),
        Estimate(difference, difference - 0.5, difference + 0.5),
    )


CHANGES = [
    change("heard", 10, 1, {"x": 1}),
    change("sent", 0, 1, {"x": 1}),
    change("delay in s", -2, 1, {"x": 1}),
    change("heard", 20, -1, {"x": 2}),
    Change({"mode": "integrated", "x": 2}, "lost", 0, Estimate(1), None, None),
]


def test_changes_are_in_percent_of_the_first_mean() -> None:
    numbers = changes_numbers(CHANGES, "a", "b")
    assert [curve.label for curve in numbers.curves] == ["x = 1", "x = 2"]
    assert [curve.columns["percent"] for curve in numbers.curves] == [[10, 50], [-5]]
    assert numbers.curves[0].columns["percent_low"] == [5, 25]
    assert numbers.curves[0].columns["percent_high"] == [15, 75]
    assert numbers.curves[0].columns["difference"] == [1, 1]
    assert numbers.categories == ["heard", "delay in s"]


def test_what_is_drawn(axes: Axes) -> None:
    numbers = changes_numbers(CHANGES, "a", "b")
    assert draw_changes(axes, numbers) is axes
    assert [label.get_text() for label in axes.get_yticklabels()] == ["heard", "delay in s"]
    points = [container[0].get_xydata().tolist() for container in axes.containers]
    assert points == [[[10, -0.15], [50, 0.85]], [[-5, 0.15]]]
    assert axes.get_ylim() == (1.5, -0.5)
    assert axes.get_xlabel() == "b - a,\nin % of a"
    assert axes.get_title(loc="right") == "mean of paired differences, 95 % interval, n = 5 pairs"


def test_many_quantities_need_a_higher_figure() -> None:
    few = changes_numbers([CHANGES[0]], "a", "b")
    many = changes_numbers([change(str(index), 1, 1, {}) for index in range(30)], "a", "b")
    assert few.height_in == 2.4
    assert many.height_in > 5


def test_nothing_to_draw() -> None:
    with pytest.raises(ConfigError, match=r": a .* 0"):
        changes_numbers(CHANGES[1:2], "a", "b")
