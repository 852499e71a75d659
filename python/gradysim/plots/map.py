"""Positions of nodes: the trajectories of one run, from above."""

import math
from collections.abc import Sequence
from operator import mul
from typing import TYPE_CHECKING

from gradysim.plots.figure import COLORS, MARKERS, set_texts, styles_of
from gradysim.plots.numbers import Curve, Numbers
from gradysim.results.run_table import Runs, nodes_of
from gradysim.results.tracked_variables import group_of
from gradysim.scenario.errors import ConfigError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_TOLERANCE_M = 0.1
"""Points that are this close to a line between others are left out."""

_MOST_NAMES = 6
"""Largest number of moving nodes in the legend."""

Point = tuple[float, float, float, float]
"""Time in s and coordinates in m."""


def map_numbers(runs: Runs) -> Numbers:
    """Return the trajectory of each node of the first run that is in its `.vec` file.

    Other nodes have one point, their final position. Raises ConfigError and OSError.
    """
    run = next(iter(Runs(runs)))
    one = Runs([run])
    coordinates: dict[str, dict[str, tuple[Sequence[float], Sequence[float]]]] = {}
    for _, name, coordinate, times_s, values in one.vectors("position?"):
        coordinates.setdefault(name, {})[coordinate] = times_s, values
    if not coordinates:
        raise ConfigError(
            f"{run.file.with_suffix('.vec')}: it has no positions",
            expected="a file of `gradysim run --vectors NODE`",
        )
    curves = []
    for node in nodes_of(run):
        axes = coordinates.get(node["name"])
        if axes and len(axes["positionX"][0]):
            positions = (axes[f"position{axis}"][1] for axis in "XYZ")
            points = _corners(list(zip(axes["positionX"][0], *positions, strict=True)))
        else:
            points = [(run.numbers["sim_time_s"], *node["position"])]
        columns = zip(*points, strict=True)
        time_s, x_m, y_m, z_m = map(list, columns)
        curves.append(Curve({"node": node["name"]}, {"x_m": x_m, "y_m": y_m, "z_m": z_m, "time_s": time_s}))
    return Numbers(draw_map, curves, "x (m)", "y (m)", f"{run.name}, {run.mode} mode, seed {run.seed}")


def draw_map(axes: "Axes", numbers: Numbers) -> "Axes":
    """Draw a line for each moving node, with a dot at its end, and a marker for each stationary node."""
    moving = [
        curve for curve in numbers.curves if len(set(zip(curve.x, curve.columns["y_m"], strict=True))) > 1
    ]
    for curve, style in zip(moving, styles_of(moving), strict=True):
        label = curve.label if len(moving) <= _MOST_NAMES else None
        x_m, y_m = curve.x, curve.columns["y_m"]
        axes.plot(x_m, y_m, label=label, color=style["color"], linestyle=style["linestyle"])
        axes.plot(x_m[-1:], y_m[-1:], color=style["color"], marker="o")
    standing: dict[str, list[tuple[float, float]]] = {}
    for curve in numbers.curves:
        if curve not in moving:
            end = (curve.x[-1], curve.columns["y_m"][-1])
            standing.setdefault(group_of(curve.label), []).append(end)
    for (group, ends), marker in zip(standing.items(), MARKERS[1:] * len(standing), strict=False):
        x, y = zip(*ends, strict=True)
        axes.plot(
            x, y, label=group, marker=marker, color=COLORS[-1], linestyle="none", markerfacecolor="none"
        )
    axes.set_aspect("equal", adjustable="datalim")
    set_texts(axes, numbers)
    return axes


def _corners(points: Sequence[Point]) -> list[Point]:
    """Return the points without intermediate points of straight lines.

    Source: K. Reumann and A. P. M. Witkam, Optimizing curve segmentation in computer graphics, 1974; here the
    start of a way back over the same line is a corner, too.
    """
    kept = [points[0]]
    farthest, reach_m = points[0], 0.0
    direction: tuple[float, ...] = ()
    for point in points[1:]:
        offset = _difference(point, kept[-1])
        if direction:
            along_m = sum(map(mul, offset, direction))
            beside_m = math.hypot(*(a - along_m * b for a, b in zip(offset, direction, strict=True)))
            if beside_m > _TOLERANCE_M or along_m < reach_m - _TOLERANCE_M:
                kept.append(farthest)
                direction, reach_m = (), 0.0
                offset = _difference(point, farthest)
            else:
                reach_m = max(reach_m, along_m)
        length_m = math.hypot(*offset)
        if not direction and length_m > _TOLERANCE_M:
            direction, reach_m = tuple(each / length_m for each in offset), length_m
        farthest = point
    return [*kept, points[-1]] if len(points) > 1 else kept


def _difference(point: Point, other: Point) -> tuple[float, ...]:
    return tuple(a - b for a, b in zip(point[1:], other[1:], strict=True))
