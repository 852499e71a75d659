"""Paired differences of several quantities, relative to the first set of runs, with their intervals."""

from collections.abc import Iterable
from dataclasses import astuple, replace
from typing import TYPE_CHECKING, Any

from gradysim.plots.figure import HEIGHT_IN, set_texts, styles_of
from gradysim.plots.numbers import Curve, Numbers, bars, caption_of
from gradysim.results.compare import Change, varying_values
from gradysim.results.quantity_table import grouped
from gradysim.scenario.errors import ConfigError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_HEIGHT_OF_MARKER_IN = 0.14
_HEIGHT_OF_GAP_IN = 0.12
"""Between two quantities."""
_HEIGHT_OF_TEXTS_IN = 0.8
"""Axis, label and caption."""


def changes_numbers(changes: Iterable[Change], first: str, second: str) -> Numbers:
    """Return the changes in percent of the mean of `first`, for each combination of values.

    Quantities whose mean is 0 in the first set have no such change and are left out. Raises ConfigError if
    none is left.
    """
    drawn = [change for change in changes if change.difference and change.first and change.first.mean]
    if not drawn:
        raise ConfigError(f"there is no change to draw: {first} has no mean other than 0")
    varying = varying_values(drawn)
    curves = []
    for values, alike in grouped(drawn, lambda change: tuple(map(change.values.get, varying))).items():
        rows = list(map(_row, alike))
        columns = {name: [row[name] for row in rows] for name in rows[0]}
        curves.append(Curve(dict(zip(varying, values, strict=True)), columns))
    caption = caption_of("mean of paired differences", [change.pairs for change in drawn], "pair")
    categories = list(dict.fromkeys(change.quantity for change in drawn))
    of_quantity_in = len(curves) * _HEIGHT_OF_MARKER_IN + _HEIGHT_OF_GAP_IN
    height_in = max(HEIGHT_IN, len(categories) * of_quantity_in + _HEIGHT_OF_TEXTS_IN)
    x_label = f"{second} - {first},\nin % of {first}"
    return Numbers(draw_changes, curves, x_label, "", caption, categories, height_in)


def _row(change: Change) -> dict[str, Any]:
    assert change.first is not None
    assert change.second is not None
    assert change.difference is not None
    difference, low, high = astuple(change.difference)
    percent = 100 / abs(change.first.mean)
    return {
        "quantity": change.quantity,
        "pairs": change.pairs,
        "first": change.first.mean,
        "second": change.second.mean,
        "difference": difference,
        "low": low,
        "high": high,
        "percent": difference * percent,
        "percent_low": None if low is None else low * percent,
        "percent_high": None if high is None else high * percent,
    }


def draw_changes(axes: "Axes", numbers: Numbers) -> "Axes":
    """Draw a row for each quantity, with a marker for each curve. The first ones are at the top."""
    curves = numbers.curves
    axes.axvline(0, color="gray", linewidth=0.6)
    for index, (curve, style) in enumerate(zip(curves, styles_of(curves), strict=True)):
        shift = (index + 0.5) / len(curves) - 0.5
        positions = [numbers.categories.index(quantity) + 0.6 * shift for quantity in curve.x]
        means, low, high = (curve.columns[name] for name in ("percent", "percent_low", "percent_high"))
        style["linestyle"] = "none"
        axes.errorbar(means, positions, xerr=bars(means, low, high), label=curve.label, **style)
    set_texts(axes, replace(numbers, categories=()))
    axes.set_yticks(range(len(numbers.categories)), list(numbers.categories))
    axes.set_ylim(len(numbers.categories) - 0.5, -0.5)
    return axes
