"""Builds the nodes of a scenario from the rows of their kinds.

Nodes with the same lines in force share the mappings made from them, so a thousand such nodes cost little
more than one.
"""

from collections.abc import Mapping, Set
from dataclasses import dataclass, replace

from gradysim.protocol.position import LARGEST_COORDINATE_M, Position
from gradysim.scenario.errors import ConfigError, ErrorCollector, Source
from gradysim.scenario.groups import Group
from gradysim.scenario.interfaces import InterfaceBuilder
from gradysim.scenario.keys import MASSLESS, PROTOCOL_KEYS, QUADCOPTER, STATIC_GRID, STATIONARY
from gradysim.scenario.lines import Line, Row, read_struct, rows_in_force
from gradysim.scenario.node_spec import AutopilotSpec, InterfaceSpec, NodeSpec, read_autopilot
from gradysim.scenario.paths import path_of
from gradysim.scenario.placement import AXES, Grid, Placement, read_grid
from gradysim.scenario.resolution import NodeKind, Resolution
from gradysim.scenario.values import Setting, SettingReader

_NO_GRID = Grid(1, (0.0, 0.0), (0.0, 0.0))


@dataclass(frozen=True, eq=False)
class _Common:
    """What nodes of one kind have in common.

    Attributes:
        row: Start and step in meters for each axis, or None on an axis of a grid.
        steps: The lines of the steps.
        grid_settings: Settings of the grid. Its size also depends on the group.
        grid_line: The place that asks for the grid, or None.
    """

    protocol_parameters: Mapping[str, object]
    protocol_sources: Mapping[str, Source]
    row: tuple[tuple[float, float] | None, ...]
    steps: tuple[Line | None, ...]
    grid_settings: Mapping[str, Setting]
    grid_line: Source | None
    mobility: Mapping[str, Setting]
    node: Mapping[str, Setting]
    computer: Mapping[str, Setting]
    wlan: tuple[InterfaceSpec, ...]
    autopilot: AutopilotSpec | None
    idle_autopilot: Mapping[str, Setting]


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
            grid = builder.grid(common, group)
            x, y, z = (
                builder.coordinate_m(name, index, axis, row, step)
                if row is not None
                else grid.coordinate_m(index, axis)
                for axis, row, step in zip(AXES, common.row, common.steps, strict=True)
            )
            place = builder.start(common.mobility, (x, y, z))
            nodes.append(
                NodeSpec(
                    id=len(nodes),
                    name=name,
                    group=group.name,
                    index=index,
                    protocol=kind.protocol.cls,
                    protocol_parameters=common.protocol_parameters,
                    initial_position=place,
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
        self._structs: dict[object, Mapping[str, Setting]] = {}
        self._kept: list[Mapping[str, Setting]] = []  # so that their ids are not reused
        self._sources: dict[NodeKind, Mapping[str, Source]] = {}
        self._grids: dict[tuple[_Common, str], Grid] = {}

    def common(self, name: str, kind: NodeKind) -> _Common:
        """Return what a node has in common with those of its kind, or its own if lines draw its values."""
        common = self._common.get(kind)
        if common is None:
            common = self._make(name, kind)
            if not kind.differs:
                self._common[kind] = common
        return common

    def grid(self, common: _Common, group: Group) -> Grid:
        """Return the grid of those nodes of a group; an empty one if they are not in a grid."""
        if common.grid_line is None:
            return _NO_GRID
        grid = self._grids.get((common, group.name))
        if grid is None:
            grid = _NO_GRID
            with self._errors.collecting():
                grid = read_grid(common.grid_settings, group, common.grid_line)
            self._grids[common, group.name] = grid
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

    def start(self, mobility: Mapping[str, Setting], place: Position) -> Position:
        """Return where a node starts: on its path if it has one, otherwise at `place`."""
        with self._errors.collecting():
            if path := path_of(mobility, place):
                return path(0)
            typename = mobility.get("typename")
            if typename is not None and typename.value == QUADCOPTER and place[2] < 0:
                text = f"the node starts below the ground, at z = {place[2]:g}m"
                raise ConfigError.at(typename.source, text, expected="at least 0m")
        return place

    def _make(self, name: str, kind: NodeKind) -> _Common:
        wlan = self._interfaces.interfaces(name, kind)
        parameters = self._read("protocol", name, kind)
        position = rows_in_force("position", kind.rows.values())
        lines = {field: row.line for field, row in position.items()}
        mobility = self._read("mobility", name, kind)
        typename = mobility.get("typename")
        if typename is not None and typename.value == STATIC_GRID:
            mobility = self._with_typename(mobility, STATIONARY)
            lines[STATIC_GRID] = kind.rows["mobility.typename"].line
        placement = Placement(lines)
        error_count = len(self._errors.errors)
        grid_settings = self._position(f"{name}.", position, placement.idle)
        has_position = len(self._errors.errors) == error_count
        values = {field: float(setting.value) for field, setting in grid_settings.items()}
        idle_autopilot = self._read("autopilot", name, kind)
        autopilot = None
        with self._errors.collecting():
            autopilot = read_autopilot(mobility, idle_autopilot)
        if autopilot is not None:
            mobility, idle_autopilot = self._with_typename(mobility, MASSLESS), {}
        return _Common(
            {field: setting.value for field, setting in parameters.items()},
            self._sources_of(kind, parameters),
            tuple(placement.row(axis, values) for axis in AXES),
            tuple(lines.get(f"line_step_{axis}") for axis in AXES),
            grid_settings,
            placement.grid_line if has_position else None,
            mobility=mobility,
            node=self._read("node", name, kind),
            computer=self._read("computer", name, kind),
            wlan=wlan,
            autopilot=autopilot,
            idle_autopilot=idle_autopilot,
        )

    def _read(self, struct: str, name: str, kind: NodeKind) -> Mapping[str, Setting]:
        """Return the fields of a struct; nodes of all kinds with the same lines share the mapping."""
        rows = [
            row for row in kind.rows.values() if row.key.struct == struct and row.key not in PROTOCOL_KEYS
        ]
        if any(row.line.differs for row in rows):
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

    def _position(self, prefix: str, rows: Mapping[str, Row], idle: Set[str]) -> dict[str, Setting]:
        """Read the settings of a node's initial position; those that are not in force are only checked."""
        checked = [row for field, row in rows.items() if field in idle]
        others = [row for field, row in rows.items() if field not in idle]
        settings = read_struct("position", checked, self._settings.for_checks(), self._errors, prefix)
        return settings | read_struct("position", others, self._settings, self._errors, prefix)
