"""Means over the runs of each value of a variable, and differences between runs of the same seed."""

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

from gradysim.plots.figure import set_texts, styles_of
from gradysim.plots.numbers import (
    Curve,
    Numbers,
    bars,
    caption_of,
    check_quantity,
    columns_of,
    label_of,
    mean_columns,
    series_of,
    x_axis,
)
from gradysim.results.compare import Pairs
from gradysim.results.quantity_table import QuantityTable, grouped, variables_of
from gradysim.results.run_table import Runs
from gradysim.scenario.errors import ConfigError, unknown_name

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MOST_TICKS = 12
"""Largest number of values that are ticks of an axis."""

_WIDTH_OF_CATEGORY = 0.5
"""Relative to the distance of two categories: the curves are next to each other within it."""


def line_numbers(runs: Runs, *, x: str, y: str, by: Iterable[str] | None = None) -> Numbers:
    """Return the mean of `y` for each value of `x`. Raises ConfigError."""
    axis = x_axis(runs, x)
    check_quantity(runs, y)
    curves = []
    for values, alike in series_of(runs, by, x):
        by_x = grouped(alike, lambda run: variables_of(run).get(x))
        found = {
            position: numbers
            for value, position in axis.positions.items()
            if (numbers := QuantityTable(by_x.get(value, ())).numbers(y))
        }
        if found:
            columns = mean_columns(list(found.values()), binary=runs.is_binary(y))
            curves.append(Curve(values, {axis.label: list(found), **columns}))
    counts = [count for curve in curves for count in curve.columns["runs"]]
    caption = caption_of("mean", counts)
    return Numbers(draw_line, curves, axis.label, label_of(y), caption, axis.categories)


def diff_numbers(
    runs: Runs, *, x: str, y: str, by: Iterable[str] | None = None, baseline: str | None = None
) -> Numbers:
    """Return the mean of the differences of `y` between runs of the same seed, for each value of `x`.

    The first variable of `by` is compared: each of its values minus `baseline`, by default the first one.
    Raises ConfigError.
    """
    axis = x_axis(runs, x)
    check_quantity(runs, y)
    series = series_of(runs, by, x)
    compared, *others = *series[0][0], x
    names = list(dict.fromkeys(str(values.get(compared)) for values, _ in series))
    if len(names) < 2:
        raise ConfigError(
            "there is nothing to compare", expected="--by VARIABLE, one of which the runs have two values"
        )
    base = names[0] if baseline is None else baseline
    if base not in names:
        raise unknown_name(f"no run has {compared} = {base}", base, names)
    of_base = [run for values, alike in series if str(values[compared]) == base for run in alike]
    binary = {y} if runs.is_binary(y) else ()
    curves = []
    for values, alike in series:
        if str(values[compared]) == base:
            continue
        changes = Pairs.of(of_base, alike, others).changes_of([y], binary)
        by_x = {change.values[x]: change for change in changes if change.difference}
        drawn = [(position, by_x[value]) for value, position in axis.positions.items() if value in by_x]
        if drawn:
            columns = {
                axis.label: [position for position, _ in drawn],
                **columns_of([change.difference for _, change in drawn if change.difference]),
                "pairs": [change.pairs for _, change in drawn],
                "higher": [change.higher for _, change in drawn],
            }
            curves.append(Curve({**values, compared: f"{values[compared]} - {base}"}, columns))
    if not curves:
        raise ConfigError(
            f"no two runs that differ in `{compared}` have the same seed",
            expected="`seed-set = ${repetition}` in the study",
        )
    counts = [count for curve in curves for count in curve.columns["pairs"]]
    caption = f"{caption_of('mean of paired differences', counts, 'pair')}; k/n: higher in k of n"
    return Numbers(draw_diff, curves, axis.label, f"difference of {label_of(y)}", caption, axis.categories)


def draw_line(axes: "Axes", numbers: Numbers) -> "Axes":
    """Draw means with error bars; a line connects them if the x axis is a number."""
    curves = numbers.curves
    for index, (curve, style) in enumerate(zip(curves, styles_of(curves), strict=True)):
        means, low, high = (curve.columns[name] for name in ("mean", "low", "high"))
        if numbers.categories:
            shift = _WIDTH_OF_CATEGORY * ((index + 0.5) / len(curves) - 0.5)
            positions: Sequence[float] = [numbers.categories.index(name) + shift for name in curve.x]
            style["linestyle"] = "none"
        else:
            positions = curve.x
        axes.errorbar(positions, means, yerr=bars(means, low, high), label=curve.label, **style)
    set_texts(axes, numbers)
    if numbers.categories:
        axes.set_xlim(-0.5, len(numbers.categories) - 0.5)
    else:
        _set_ticks(axes, sorted({float(value) for curve in curves for value in curve.x}))
    return axes


def _set_ticks(axes: "Axes", values: Sequence[float]) -> None:
    """Use the values as ticks if there is room, otherwise integers if all values are integers."""
    least_gap = min((high - low for low, high in pairwise(values)), default=0)
    if len(values) <= _MOST_TICKS and least_gap * _MOST_TICKS >= values[-1] - values[0]:
        axes.set_xticks(values, [f"{value:g}" for value in values])
    elif all(value.is_integer() for value in values):
        axes.locator_params(axis="x", integer=True)


def draw_diff(axes: "Axes", numbers: Numbers) -> "Axes":
    """Draw mean differences, and the number of pairs in which the value is higher than the baseline."""
    axes.axhline(0, color="gray", linewidth=0.6)
    draw_line(axes, numbers)
    axes.legend()
    for curve, container in zip(numbers.curves, axes.containers, strict=False):
        points = container[0]
        for position, mean, higher, pairs in zip(
            points.get_xdata(),
            curve.columns["mean"],
            curve.columns["higher"],
            curve.columns["pairs"],
            strict=True,
        ):
            axes.annotate(
                f"{higher}/{pairs}", (position, mean), (4, 3), textcoords="offset points", fontsize="x-small"
            )
    return axes
