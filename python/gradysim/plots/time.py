"""A tracked variable over simulated time, averaged over runs."""

from bisect import bisect_right
from collections.abc import Iterable, Sequence
from statistics import fmean
from typing import TYPE_CHECKING

from gradysim.plots.figure import set_texts, styles_of
from gradysim.plots.numbers import Curve, Numbers, band, caption_of, mean_columns, series_of
from gradysim.results.confidence_interval import are_binary
from gradysim.results.run_table import Runs
from gradysim.results.tracked_variables import group_of
from gradysim.scenario.errors import ConfigError, nearest

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_STEPS = 240
"""Intervals between the points of a curve."""

_UNITS = ((36_000.0, 3600.0, "h"), (600.0, 60.0, "min"), (0.0, 1.0, "s"))
"""(shortest time in s, s per unit, unit) of the axis."""

Vector = tuple[Sequence[float], Sequence[float]]
"""Times in s, and the value from each time on."""


def time_numbers(runs: Runs, *, y: str, by: Iterable[str] | None = None) -> Numbers:
    """Return a tracked variable over time from `.vec` files: for each run the mean of a group's nodes.

    `y` is `uavs[*] heard`, as in `gradysim means`, or `uavs[*] positionZ`. Raises ConfigError and OSError.
    """
    group = next((name for run in runs for name in run.conditions.groups if y.startswith(f"{name} ")), "")
    variable = y.removeprefix(f"{group} ")
    found: dict[int, list[Vector]] = {}
    for run, node, _, times_s, recorded in runs.vectors([variable] if group else []):
        if group_of(node) == group:
            found.setdefault(id(run), []).append((times_s, recorded))
    if not found:
        names = vector_names(runs)
        raise ConfigError(
            f"no `.vec` file of the runs has `{y}`",
            expected=f"one of {', '.join(names)}" if names else "files of `gradysim run --vectors NODE`",
            suggestion=nearest(y, names),
        )
    end_s = max(run.numbers["sim_time_s"] for run in runs)
    per_unit, unit = next((per_unit, unit) for least, per_unit, unit in _UNITS if end_s >= least)
    known, counts = [], []
    for values, alike in series_of(runs, by):
        vectors = [found[id(run)] for run in alike if id(run) in found]
        until_s = min(run.numbers["sim_time_s"] for run in alike)
        grid_s = [until_s * step / _STEPS for step in range(_STEPS + 1)]
        means = [[_mean_at(each, time_s) for each in vectors] for time_s in grid_s]
        points = {
            time_s / per_unit: numbers
            for time_s, row in zip(grid_s, means, strict=True)
            if (numbers := [number for number in row if number is not None])
        }
        if points:
            known.append((values, points))
            counts.append(len(vectors))
    binary = all(are_binary(numbers) for _, points in known for numbers in points.values())
    curves = [
        Curve(values, {f"time ({unit})": list(points), **mean_columns(list(points.values()), binary=binary)})
        for values, points in known
    ]
    caption = caption_of("mean", counts)
    return Numbers(draw_time, curves, f"time ({unit})", y, caption)


def vector_names(runs: Runs) -> list[str]:
    """Return the names for `y`: `uavs[*] heard` and so on."""
    return list(dict.fromkeys(f"{group_of(node)} {name}" for _, node, name, *_ in runs.vectors()))


def draw_time(axes: "Axes", numbers: Numbers) -> "Axes":
    """Draw lines with bands of the 95 % intervals."""
    for curve, style in zip(numbers.curves, styles_of(numbers.curves), strict=True):
        low, high = band(curve)
        axes.plot(curve.x, curve.columns["mean"], label=curve.label, **{**style, "marker": "none"})
        axes.fill_between(curve.x, low, high, color=style["color"], alpha=0.2, linewidth=0)
    set_texts(axes, numbers)
    return axes


def _mean_at(vectors: Sequence[Vector], time_s: float) -> float | None:
    """Return the mean value of the nodes at a time; None before the first number."""
    values = [
        value
        for times_s, numbers in vectors
        if (index := bisect_right(times_s, time_s)) and (value := numbers[index - 1]) == value
    ]
    return fmean(values) if values else None
