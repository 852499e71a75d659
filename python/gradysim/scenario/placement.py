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
from gradysim.scenario.groups import Group
from gradysim.scenario.keys import STATIC_GRID
from gradysim.scenario.lookup import Found, Setting

AXES = ("x", "y", "z")
_AXES_OF_GRID = ("x", "y")

_LINE, _INITIAL, _GRID = (
    ("line_start_{}", "line_step_{}"),
    ("initial_{}",),
    ("margin_{}", "separation_{}", "num_hosts", "columns", "rows", STATIC_GRID),
)
"""Fields of a position, by the three ways to set it along an axis; of equal entries the first way counts."""


def _entries(way: tuple[str, ...], axis: str, found: Mapping[str, Found]) -> list[Found]:
    """Return the entries that place nodes in one way along an axis."""
    entries = [entry for field in way if (entry := found.get(field.format(axis)))]
    if way is _GRID:
        return [entry for entry in entries if axis in _AXES_OF_GRID and not entry.is_default]
    return entries


def _way(axis: str, found: Mapping[str, Found]) -> tuple[str, ...]:
    """Return the way in force along an axis."""
    orders = {way: [entry.order for entry in _entries(way, axis, found)] for way in (_LINE, _INITIAL, _GRID)}
    return min(orders, key=lambda way: min(orders[way], default=math.inf))


def idle_fields(found: Mapping[str, Found]) -> set[str]:
    """Return the fields without effect on the initial position."""
    ways = {axis: _way(axis, found) for axis in AXES}
    return {
        field.format(axis)
        for axis, in_force in ways.items()
        for way in (_LINE, _INITIAL, _GRID)
        for field in way
        if way is not in_force and "{" in field
    }


def axis_row(
    axis: str, found: Mapping[str, Found], values: Mapping[str, float]
) -> tuple[float, float] | None:
    """Return start and step along one axis in meters; None in a grid."""
    way = _way(axis, found)
    if way is _GRID:
        return None
    if way is _INITIAL:
        return values.get(f"initial_{axis}", 0.0), 0.0
    return values.get(f"line_start_{axis}", 0.0), values.get(f"line_step_{axis}", 0.0)


def first_of_grid(found: Mapping[str, Found]) -> Source | None:
    """Return the line that asks for a grid; None if there is no grid."""
    if _GRID not in (_way(axis, found) for axis in _AXES_OF_GRID):
        return None
    entries = (entry for axis in _AXES_OF_GRID for entry in _entries(_GRID, axis, found))
    return min(entries, key=lambda entry: entry.order).entry.source


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
        place = _AXES_OF_GRID.index(axis)
        cell = (index % self.columns, index // self.columns)[place]
        return self.margins_m[place] + (cell + 0.5) * self.separations_m[place]


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
            place = line if far is None else far.source
            raise ConfigError.at(place, text, expected=f"at most {LARGEST_COORDINATE_M}m from 0m")
    return grid


def _integer(settings: Mapping[str, Setting], field: str, default: int) -> int:
    return int(settings[field].value) if field in settings else default


def _pair(settings: Mapping[str, Setting], name: str) -> tuple[float, float]:
    x, y = (
        float(settings[field].value) if (field := f"{name}_{axis}") in settings else 0.0
        for axis in _AXES_OF_GRID
    )
    return x, y
