"""Distributions: of the delays of messages, of a tracked variable over nodes, of any number over runs."""

from bisect import bisect_right
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from gradysim.plots.figure import set_texts, styles_of
from gradysim.plots.numbers import (
    Curve,
    Numbers,
    band,
    caption_of,
    check_quantity,
    label_of,
    mean_columns,
    number_of_runs,
    series_of,
)
from gradysim.results.files import read_run_file
from gradysim.results.run_summary import RunSummary
from gradysim.results.run_table import Runs, nodes_of
from gradysim.results.tracked_variables import numbers_and_others, tracked_by_group
from gradysim.scenario.errors import ConfigError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_DELAY = " messages delay in s"

Distribution = tuple[Sequence[float], Sequence[float]]
"""Values in ascending order, and the ratio of values that do not exceed each of them."""


def cdf_numbers(runs: Runs, *, y: str, by: Iterable[str] | None = None) -> Numbers:
    """Return the ratio of values of `y` up to each value, averaged over runs.

    The values belong to messages for a delay, and to nodes for a tracked variable of a group. Other values
    belong to runs, and have no interval. Raises ConfigError and OSError.
    """
    check_quantity(runs, y)
    curves, counts, averaged = [], [], False
    for values, alike in series_of(runs, by):
        found = [each for run in alike if run.number(y) is not None and (each := _distribution(run, y))]
        if not found:
            continue
        counts.append(len(found))
        if all(len(each[0]) == 1 for each in found):  # one number per run
            found = [_of_values([each[0][0] for each in found])]
        averaged |= len(found) > 1
        grid = sorted({value for each in found for value in each[0]})
        columns = mean_columns([[_share(each, value) for each in found] for value in grid])
        columns["runs"] = [counts[-1]] * len(grid)
        curves.append(Curve(values, {y: grid, **columns}))
    caption = caption_of("distribution", counts) if averaged else f"distribution, {number_of_runs(counts)}"
    return Numbers(draw_cdf, curves, label_of(y), "share of values", caption)


def draw_cdf(axes: "Axes", numbers: Numbers) -> "Axes":
    """Draw steps with bands of the 95 % intervals."""
    for curve, style in zip(numbers.curves, styles_of(numbers.curves), strict=True):
        low, high = band(curve)
        steps = [curve.x[0], *curve.x], [0, *curve.columns["mean"]]
        axes.step(*steps, where="post", label=curve.label, **{**style, "marker": "none"})
        axes.fill_between(curve.x, low, high, step="post", color=style["color"], alpha=0.2, linewidth=0)
    axes.set_ylim(0, 1.02)
    set_texts(axes, numbers)
    return axes


def _distribution(run: RunSummary, y: str) -> Distribution | None:
    if y.endswith(_DELAY):
        kind = y.removesuffix(_DELAY)
        delays: dict[str, Any] = read_run_file(run.file)["message_delays"][kind]
        if "cumulative" not in delays:
            raise ConfigError(
                f"{run.file}: it has no distribution of delays",
                expected="a result of this version: run it again",
            )
        return delays["cumulative"]["time_s"], delays["cumulative"]["share"]
    for group, name in run.conditions.variables:
        if f"{group} {name}" == y:
            numbers, _ = numbers_and_others(tracked_by_group(nodes_of(run))[group], name)
            return _of_values(numbers) if numbers else None
    return _of_values([run.numbers[y]])


def _of_values(values: Iterable[float]) -> Distribution:
    ordered = sorted(values)
    return ordered, [(index + 1) / len(ordered) for index in range(len(ordered))]


def _share(distribution: Distribution, value: float) -> float:
    values, shares = distribution
    index = bisect_right(values, value)
    return shares[index - 1] if index else 0.0
