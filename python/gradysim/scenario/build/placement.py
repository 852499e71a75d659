"""The initial positions of nodes: set one by one, in a line, or in a grid. The first line of all is in force.

A grid is that of INET's StaticGridMobility: row by row, each node in the center of its cell.
x = marginX + (column + 1/2) separationX and y = marginY + (row + 1/2) separationY, in meters, where column
and row are the remainder and the quotient of index / columns. Scenarios have no area that would give the
separation, so it must be set.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from gradysim.protocol.position import LARGEST_COORDINATE_M
from gradysim.scenario.errors import ConfigError, Source
from gradysim.scenario.resolve.groups import Group
from gradysim.scenario.resolve.lines import Line
from gradysim.scenario.schema.keys import STATIC_GRID
from gradysim.scenario.schema.values import Setting

AXES = ("x", "y", "z")
_AXES_OF_GRID = ("x", "y")

_LINE, _INITIAL, _GRID = (
    ("line_start_{}", "line_step_{}"),
    ("initial_{}",),
    ("margin_{}", "separation_{}", "num_hosts", "columns", "rows", STATIC_GRID),
)
"""Fields of a position, by the three ways to set it along an axis; of equal lines the first way counts."""


class Placement:
    """The ways in which lines place nodes along each axis; the first line of all decides.

    Attributes:
        idle: The fields without effect on the initial position.
        steps: The line of the step of a row, for each axis.
        grid_line: The line that asks for a grid, or None.
    """

    def __init__(self, in_force: Mapping[str, Line]) -> None:
        """Take the line in force for each field."""
        self.grid_line: Source | None = None
        self._ways: dict[str, tuple[str, ...]] = {}
        of_grid: list[Line] = []
        for axis in AXES:
            lines = {way: _lines(way, axis, in_force) for way in (_LINE, _INITIAL, _GRID)}
            chosen = min(lines, key=lambda way: min((line.order for line in lines[way]), default=math.inf))
            self._ways[axis] = chosen
            if chosen is _GRID:
                of_grid += lines[_GRID]
        if of_grid:
            self.grid_line = min(of_grid, key=lambda line: line.order).entry.source
        self.steps = tuple(in_force.get(f"line_step_{axis}") for axis in AXES)
        self.idle = {
            field.format(axis)
            for axis, chosen in self._ways.items()
            for way in (_LINE, _INITIAL, _GRID)
            for field in way
            if way is not chosen and "{" in field
        }

    def row(self, axis: str, values: Mapping[str, float]) -> tuple[float, float] | None:
        """Return start and step along one axis in meters; None in a grid."""
        way = self._ways[axis]
        if way is _GRID:
            return None
        if way is _INITIAL:
            return values.get(f"initial_{axis}", 0.0), 0.0
        return values.get(f"line_start_{axis}", 0.0), values.get(f"line_step_{axis}", 0.0)


def _lines(way: tuple[str, ...], axis: str, in_force: Mapping[str, Line]) -> list[Line]:
    """Return the lines that place nodes in one way along an axis."""
    lines = [line for field in way if (line := in_force.get(field.format(axis)))]
    if way is _GRID:
        return [line for line in lines if axis in _AXES_OF_GRID and not line.is_default]
    return lines


@dataclass(frozen=True)
class Grid:
    """The initial positions of the nodes of one group.

    Attributes:
        columns: Number of nodes in a row, along x.
        margins_m: Start of the first cell: x and y.
        separations_m: Width of a cell along x and y.
    """

    columns: int
    margins_m: tuple[float, float]
    separations_m: tuple[float, float]

    def coordinate_m(self, index: int, axis: str) -> float:
        """Return x or y of the node with that index in the group."""
        of_axis = _AXES_OF_GRID.index(axis)
        cell = (index % self.columns, index // self.columns)[of_axis]
        return self.margins_m[of_axis] + (cell + 0.5) * self.separations_m[of_axis]


def read_grid(settings: Mapping[str, Setting], group: Group, line: Source) -> Grid:
    """Return the grid of a group. `line` is a line that asks for it.

    Raises ConfigError if the grid has too few cells or needs a separation that is not set.
    """
    size = group.size or 1
    hosts = _integer(settings, "num_hosts", size)
    square = math.isqrt(hosts - 1) + 1
    as_wide_as_needed = -(-hosts // int(settings["rows"].value)) if "rows" in settings else square
    columns = _integer(settings, "columns", as_wide_as_needed)
    rows = _integer(settings, "rows", -(-hosts // columns))
    if hosts < size:
        raise ConfigError.at(
            settings["num_hosts"].source,
            f"{group.written} has {size} nodes",
            expected="as many, or no such line",
        )
    if rows * columns < hosts:
        which = settings["rows"] if "rows" in settings else settings["columns"]
        raise ConfigError.at(
            which.source, f"{rows} rows of {columns} columns have no room for {hosts} nodes", expected="more"
        )
    grid = Grid(columns, _pair(settings, "margin"), _pair(settings, "separation"))
    last = (min(columns, hosts) - 1, (hosts - 1) // columns)
    for axis, cell in zip(_AXES_OF_GRID, last, strict=True):
        field = f"separation_{axis}"
        if cell > 0 and field not in settings:
            key = f"`*.{group.written}.mobility.separation{axis.upper()} = 50m`"
            raise ConfigError("nothing sets the separation of the nodes in a grid", line, expected=key)
        farthest_m = grid.coordinate_m(cell if axis == "x" else cell * columns, axis)
        if not abs(farthest_m) <= LARGEST_COORDINATE_M:
            text = f"a node would start at {axis} = {farthest_m:.12g}m"
            far = settings.get(field, settings.get(f"margin_{axis}"))
            source = line if far is None else far.source
            raise ConfigError.at(source, text, expected=f"at most {LARGEST_COORDINATE_M}m from 0m")
    return grid


def _integer(settings: Mapping[str, Setting], field: str, default: int) -> int:
    return int(settings[field].value) if field in settings else default


def _pair(settings: Mapping[str, Setting], name: str) -> tuple[float, float]:
    x, y = (
        float(settings[field].value) if (field := f"{name}_{axis}") in settings else 0.0
        for axis in _AXES_OF_GRID
    )
    return x, y
