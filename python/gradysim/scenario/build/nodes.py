"""Builds the nodes of a scenario from the rows of their kinds.

Nodes with the same lines in force share the mappings made from them, so a thousand such nodes cost little
more than one.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from gradysim.protocol.position import LARGEST_COORDINATE_M, Position
from gradysim.scenario.build.interfaces import InterfaceBuilder
from gradysim.scenario.build.paths import path_of
from gradysim.scenario.build.placement import AXES, Grid, Placement, read_grid
from gradysim.scenario.errors import ConfigError, ErrorCollector, Source
from gradysim.scenario.node_spec import AutopilotSpec, InterfaceSpec, NodeSpec, read_autopilot
from gradysim.scenario.resolve.groups import Group
from gradysim.scenario.resolve.lines import Line, Row, read_struct, rows_in_force
from gradysim.scenario.resolve.resolution import NodeKind, Resolution
from gradysim.scenario.schema.keys import MASSLESS, PROTOCOL_KEYS, QUADCOPTER, STATIC_GRID, STATIONARY
from gradysim.scenario.schema.values import Setting, SettingReader

_NO_GRID = Grid(1, (0.0, 0.0), (0.0, 0.0))


@dataclass(frozen=True, eq=False)
class _Common:
    """What nodes of one kind have in common, unless lines draw it."""

    protocol_parameters: Mapping[str, object]
    protocol_sources: Mapping[str, Source]
    mobility: Mapping[str, Setting]
    is_in_grid: bool
    node: Mapping[str, Setting]
    computer: Mapping[str, Setting]
    wlan: tuple[InterfaceSpec, ...]
    autopilot: AutopilotSpec | None
    idle_autopilot: Mapping[str, Setting]


@dataclass(frozen=True, eq=False)
class _Start:
    """How nodes of one kind are placed.

    Attributes:
        row: Start and step in meters for each axis, or None on an axis of a grid.
        steps: The lines of the steps.
        grid_settings: Settings of the grid. Its size also depends on the group.
        grid_line: The source that asks for the grid, or None.
    """

    row: tuple[tuple[float, float] | None, ...]
    steps: tuple[Line | None, ...]
    grid_settings: Mapping[str, Setting]
    grid_line: Source | None


def build_nodes(
    resolution: Resolution, settings: SettingReader, errors: ErrorCollector
) -> tuple[NodeSpec, ...]:
    """Return all nodes with a protocol, in the order of their ids. `errors` takes the errors of values."""
    builder = _NodeBuilder(resolution, settings, errors)
    nodes: list[NodeSpec] = []
    for group in resolution.groups:
        for index, name in enumerate(group.node_names()):
            kind = resolution.kinds.get(name)
            if kind is None:
                break
            common = builder.common(name, kind)
            start = builder.start(name, kind, common.is_in_grid)
            grid = builder.grid(start, group)
            x, y, z = (
                builder.coordinate_m(name, index, axis, row, step)
                if row is not None
                else grid.coordinate_m(index, axis)
                for axis, row, step in zip(AXES, start.row, start.steps, strict=True)
            )
            nodes.append(
                NodeSpec(
                    id=len(nodes),
                    name=name,
                    group=group.name,
                    index=index,
                    protocol=kind.protocol.cls,
                    protocol_parameters=common.protocol_parameters,
                    initial_position=builder.position(common.mobility, (x, y, z)),
                    mobility=common.mobility,
                    wlan=common.wlan,
                    protocol_sources=common.protocol_sources,
                    node=common.node,
                    computer=common.computer,
                    autopilot=common.autopilot,
                    idle_autopilot=common.idle_autopilot,
                )
            )
    return tuple(nodes)


class _NodeBuilder:
    def __init__(self, resolution: Resolution, settings: SettingReader, errors: ErrorCollector) -> None:
        self._settings = settings
        self._errors = errors
        self._interfaces = InterfaceBuilder(resolution, settings, errors)
        self._common: dict[NodeKind, _Common] = {}
        self._starts: dict[tuple[NodeKind, bool], _Start] = {}
        self._placements: dict[tuple[NodeKind, bool], tuple[Placement, list[Row], list[Row]]] = {}
        self._structs: dict[object, Mapping[str, Setting]] = {}
        self._kept: list[Mapping[str, Setting]] = []  # so that their ids are not reused
        self._sources: dict[NodeKind, Mapping[str, Source]] = {}
        self._grids: dict[tuple[_Start, str], Grid] = {}

    def common(self, name: str, kind: NodeKind) -> _Common:
        """Return what a node has in common with those of its kind, or its own if lines draw its values."""
        common = self._common.get(kind)
        if common is None:
            common = self._make(name, kind)
            if kind.differing <= {"position"}:
                self._common[kind] = common
        return common

    def start(self, name: str, kind: NodeKind, is_in_grid: bool) -> _Start:
        """Return how a node is placed."""
        start = self._starts.get((kind, is_in_grid))
        if start is None:
            start = self._make_start(name, kind, is_in_grid)
            if "position" not in kind.differing:
                self._starts[kind, is_in_grid] = start
        return start

    def grid(self, start: _Start, group: Group) -> Grid:
        """Return the grid of those nodes of a group; an empty one if they are not in a grid."""
        if start.grid_line is None:
            return _NO_GRID
        grid = self._grids.get((start, group.name))
        if grid is None:
            grid = _NO_GRID
            with self._errors.collecting():
                grid = read_grid(start.grid_settings, group, start.grid_line)
            self._grids[start, group.name] = grid
        return grid

    def coordinate_m(
        self, node: str, index: int, axis: str, row: tuple[float, float], step: Line | None
    ) -> float:
        """Return the initial coordinate of a node on one axis of a row."""
        coordinate = row[0] + index * row[1]
        if step is None or abs(coordinate) <= LARGEST_COORDINATE_M:
            return coordinate
        text = f"{node} starts at {axis} = {coordinate:.12g}m"
        expected = f"at most {LARGEST_COORDINATE_M}m from 0m"
        self._errors.add(ConfigError.at(step.entry.source, text, expected=expected))
        return 0.0

    def position(self, mobility: Mapping[str, Setting], start: Position) -> Position:
        """Return where a node starts: on its path if it has one, otherwise at `start`."""
        with self._errors.collecting():
            if path := path_of(mobility, start):
                return path(0)
            typename = mobility.get("typename")
            if typename is not None and typename.value == QUADCOPTER and start[2] < 0:
                text = f"the node starts below the ground, at z = {start[2]:g}m"
                raise ConfigError.at(typename.source, text, expected="at least 0m")
        return start

    def _make(self, name: str, kind: NodeKind) -> _Common:
        wlan = self._interfaces.interfaces(name, kind)
        parameters = self._read("protocol", name, kind)
        mobility = self._read("mobility", name, kind)
        typename = mobility.get("typename")
        is_in_grid = typename is not None and typename.value == STATIC_GRID
        if is_in_grid:
            mobility = self._with_typename(mobility, STATIONARY)
        idle_autopilot = self._read("autopilot", name, kind)
        autopilot = None
        with self._errors.collecting():
            autopilot = read_autopilot(mobility, idle_autopilot)
        if autopilot is not None:
            mobility, idle_autopilot = self._with_typename(mobility, MASSLESS), {}
        return _Common(
            {field: setting.value for field, setting in parameters.items()},
            self._sources_of(kind, parameters),
            mobility,
            is_in_grid,
            node=self._read("node", name, kind),
            computer=self._read("computer", name, kind),
            wlan=wlan,
            autopilot=autopilot,
            idle_autopilot=idle_autopilot,
        )

    def _make_start(self, name: str, kind: NodeKind, is_in_grid: bool) -> _Start:
        placement, idle, in_use = self._placement(kind, is_in_grid)
        error_count = len(self._errors.errors)
        checks = self._settings.for_checks()
        settings = read_struct("position", idle, checks, self._errors, f"{name}.")
        settings |= read_struct("position", in_use, self._settings, self._errors, f"{name}.")
        has_position = len(self._errors.errors) == error_count
        values = {field: float(setting.value) for field, setting in settings.items()}
        return _Start(
            tuple(placement.row(axis, values) for axis in AXES),
            placement.steps,
            settings,
            placement.grid_line if has_position else None,
        )

    def _placement(self, kind: NodeKind, is_in_grid: bool) -> tuple[Placement, list[Row], list[Row]]:
        """Return how lines place the nodes of a kind, and its rows that are only checked and those in use."""
        placed = self._placements.get((kind, is_in_grid))
        if placed is None:
            rows = rows_in_force("position", kind.by_struct.get("position", ()))
            lines = {field: row.line for field, row in rows.items()}
            if is_in_grid:
                lines[STATIC_GRID] = kind.rows["mobility.typename"].line
            placement = Placement(lines)
            idle = [row for field, row in rows.items() if field in placement.idle]
            in_use = [row for field, row in rows.items() if field not in placement.idle]
            placed = self._placements[kind, is_in_grid] = (placement, idle, in_use)
        return placed

    def _read(self, struct: str, name: str, kind: NodeKind) -> Mapping[str, Setting]:
        """Return the fields of a struct; nodes of all kinds with the same lines share the mapping."""
        rows = [row for row in kind.by_struct.get(struct, ()) if row.key not in PROTOCOL_KEYS]
        if struct in kind.differing:
            return read_struct(struct, rows, self._settings, self._errors, f"{name}.")
        known = (struct, *((row.path, row.line) for row in rows))
        if known not in self._structs:
            self._structs[known] = read_struct(struct, rows, self._settings, self._errors, f"{name}.")
        return self._structs[known]

    def _with_typename(self, mobility: Mapping[str, Setting], typename: str) -> Mapping[str, Setting]:
        known = (typename, id(mobility))
        if known not in self._structs:
            changed = replace(mobility["typename"], value=typename)
            self._structs[known] = {**mobility, "typename": changed}
            self._kept.append(mobility)
        return self._structs[known]

    def _sources_of(self, kind: NodeKind, parameters: Mapping[str, Setting]) -> Mapping[str, Source]:
        if kind not in self._sources:
            sources = {field: setting.source for field, setting in parameters.items()}
            self._sources[kind] = {"": kind.protocol.source, **sources}
        return self._sources[kind]
