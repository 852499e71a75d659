"""Builds the nodes of a scenario: for each node the entries in force, and what they say.

Nodes with the same entries in force share the mappings made of them, so that a thousand of them cost little
more than one.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.position import LARGEST_COORDINATE_M
from gradysim.scenario.errors.config_error import BadValue, ConfigError
from gradysim.scenario.errors.nearest import nearest
from gradysim.scenario.errors.source import Source
from gradysim.scenario.keys import (
    MASSLESS,
    MOBILITY_KEYS,
    NODE_KEYS,
    PROTOCOL_CLASS,
    PROTOCOL_KEYS,
    PROTOCOL_TYPENAME,
    STATIC_GRID,
    STATIONARY,
    WLAN_KEYS,
)
from gradysim.scenario.matching.groups import Group
from gradysim.scenario.matching.key_suggestion import is_misspelt_class
from gradysim.scenario.matching.lookup import Candidates, Found, Lookup
from gradysim.scenario.matching.struct_reader import read_struct
from gradysim.scenario.native_protocols import native_protocol
from gradysim.scenario.node.autopilot_spec import AutopilotSpec, read_autopilot
from gradysim.scenario.node.grid import AXES_OF_GRID, GRID_FIELDS, Grid, read_grid
from gradysim.scenario.node.interface_spec import InterfaceSpec
from gradysim.scenario.node.interfaces import InterfaceBuilder
from gradysim.scenario.node.node_spec import NodeSpec
from gradysim.scenario.parameter_types import ParameterType
from gradysim.scenario.parameters import parameters_of
from gradysim.scenario.protocols import ProtocolLoader
from gradysim.scenario.schema import Key
from gradysim.scenario.settings import Setting, SettingReader

_AXES = ("x", "y", "z")
_TYPENAME = next(key for key in MOBILITY_KEYS if key.target == "mobility.typename")
_NO_GRID = Grid(1, (0.0, 0.0), (0.0, 0.0))


@dataclass(frozen=True, eq=False)
class _Shared:
    """What nodes with the same entries in force have in common; row is start and step for each axis.

    `steps` are the entries that say the steps. On an axis without a row they start in a grid, which
    `grid_settings` and the size of their group make; `grid_line` is where it is asked for.
    """

    protocol_parameters: Mapping[str, object]
    protocol_sources: Mapping[str, Source]
    row: tuple[tuple[float, float] | None, ...]
    steps: tuple[Found | None, ...]
    grid_settings: Mapping[str, Setting]
    grid_line: Source | None
    mobility: Mapping[str, Setting]
    node: Mapping[str, Setting]
    wlan: tuple[InterfaceSpec, ...]
    autopilot: AutopilotSpec | None
    idle_autopilot: Mapping[str, Setting]


@dataclass(frozen=True, eq=False)
class ChosenProtocol:
    """The protocol of some nodes, the line that says so, and the files that it consists of."""

    cls: type[IProtocol]
    source: Source
    files: tuple[Path, ...] = ()


def load_protocols(
    lookup: Lookup, groups: list[Group], settings: SettingReader, loader: ProtocolLoader
) -> dict[str, ChosenProtocol]:
    """The protocol of each node, by name. Raises ConfigError if a node has none or it does not load."""
    candidates = [(key, lookup.candidates(key.path)) for key in PROTOCOL_KEYS]
    protocols: dict[str, ChosenProtocol] = {}
    by_entry: dict[Found, ChosenProtocol] = {}
    for group in groups:
        for name in group.node_names():
            given = [
                (found.order, key, found)
                for key, of_key in candidates
                if (found := of_key.first(name)) is not None and not found.is_default
            ]
            if not given:
                raise _misspelt_class_error(lookup, group, name) or _no_class_error(group, groups, name)
            _, key, found = min(given, key=lambda each: each[0])
            if found not in by_entry:
                load = _load_class if key is PROTOCOL_CLASS else _native_class
                by_entry[found] = load(found, settings, loader)
            protocols[name] = by_entry[found]
    return protocols


def build_nodes(
    lookup: Lookup,
    groups: list[Group],
    protocols: Mapping[str, ChosenProtocol],
    interface_counts: Mapping[str, int],
    settings: SettingReader,
) -> tuple[NodeSpec, ...]:
    """All nodes, in the order of their ids. Raises ConfigError for a value that is none."""
    builder = _NodeBuilder(lookup, settings)
    nodes: list[NodeSpec] = []
    for group in groups:
        for index, name in enumerate(group.node_names()):
            shared = builder.shared(name, protocols[name], interface_counts[name])
            grid = builder.grid(shared, group)
            x, y, z = (
                _coordinate(name, index, axis, row, step)
                if row is not None
                else grid.coordinate_m(index, axis)
                for axis, row, step in zip(_AXES, shared.row, shared.steps, strict=True)
            )
            nodes.append(
                NodeSpec(
                    id=len(nodes),
                    name=name,
                    group=group.name,
                    index=index,
                    protocol=protocols[name].cls,
                    protocol_parameters=shared.protocol_parameters,
                    initial_position=(x, y, z),
                    mobility=shared.mobility,
                    wlan=shared.wlan,
                    protocol_sources=shared.protocol_sources,
                    node=shared.node,
                    autopilot=shared.autopilot,
                    idle_autopilot=shared.idle_autopilot,
                )
            )
    return tuple(nodes)


class _NodeBuilder:
    def __init__(self, lookup: Lookup, settings: SettingReader) -> None:
        self._lookup = lookup
        self._settings = settings
        self._keys = [
            (key, candidates)
            for key in NODE_KEYS
            if key not in (*PROTOCOL_KEYS, *WLAN_KEYS) and (candidates := lookup.candidates(key.path))
        ]
        self._parameters: dict[type[IProtocol], list[tuple[str, ParameterType, Candidates]]] = {}
        self._interfaces = InterfaceBuilder(lookup, settings)
        self._shared: dict[object, _Shared] = {}
        self._grids: dict[tuple[_Shared, str], Grid] = {}

    def shared(self, name: str, protocol: ChosenProtocol, interface_count: int) -> _Shared:
        cls = protocol.cls
        parameters = self._parameters.get(cls)
        if parameters is None:
            parameters = self._parameters[cls] = [
                (parameter, kind, candidates)
                for parameter, kind in parameters_of(cls).items()
                if (candidates := self._lookup.candidates(f"protocol.{parameter}"))
            ]
        found = [candidates.first(name) for _, candidates in self._keys]
        found_parameters = [candidates.first(name) for _, _, candidates in parameters]
        wlan = self._interfaces.interfaces(name, interface_count)
        in_force = (protocol, *map(id, wlan), *found, *found_parameters)
        differs = any(entry.differs for entry in (*found, *found_parameters) if entry)
        shared = self._shared.get(in_force)
        if shared is None or differs:  # the same lines give each node other values
            made = self._make(
                name,
                {key: entry for (key, _), entry in zip(self._keys, found, strict=True) if entry},
                wlan,
                protocol.source,
                {
                    parameter: self._settings.setting(entry.entry, kind, f"{name}.protocol.{parameter}")
                    for (parameter, kind, _), entry in zip(parameters, found_parameters, strict=True)
                    if entry and not entry.is_default
                },
            )
            shared = _with_mappings_of(shared, made) if shared else made
            self._shared[in_force] = shared
        return shared

    def grid(self, shared: _Shared, group: Group) -> Grid:
        """Return the grid of those nodes of a group; one that nobody reads if they are in none."""
        if shared.grid_line is None:
            return _NO_GRID
        grid = self._grids.get((shared, group.name))
        if grid is None:
            grid = read_grid(shared.grid_settings, group, shared.grid_line)
            self._grids[shared, group.name] = grid
        return grid

    def _make(
        self,
        name: str,
        found: dict[Key, Found],
        wlan: tuple[InterfaceSpec, ...],
        chosen_at: Source,
        protocol_settings: dict[str, Setting],
    ) -> _Shared:
        parameters = {name: setting.value for name, setting in protocol_settings.items()}
        sources = {name: setting.source for name, setting in protocol_settings.items()}
        position = {key.field: entry for key, entry in found.items() if key.struct == "position"}

        def path_of(key: Key) -> str:
            return f"{name}.{key.path}"

        mobility = read_struct("mobility", found, self._settings, path_of)
        typename = mobility.get("typename")
        is_static_grid = typename is not None and typename.value == STATIC_GRID
        if is_static_grid:
            mobility["typename"] = replace(mobility["typename"], value=STATIONARY)
            position[STATIC_GRID] = found[_TYPENAME]
        position_settings = self._position(found, position, path_of)
        values = {field: float(setting.value) for field, setting in position_settings.items()}
        autopilot_settings = read_struct("autopilot", found, self._settings, path_of)
        autopilot = read_autopilot(mobility, autopilot_settings)
        if autopilot is not None:
            mobility["typename"] = replace(mobility["typename"], value=MASSLESS)
        row = tuple(_axis_row(axis, position, values) for axis in _AXES)
        steps = tuple(position.get(f"line_step_{axis}") for axis in _AXES)
        asked_for = [entry for axis in AXES_OF_GRID for entry in _grid_entries(axis, position)]
        first = min(asked_for, key=lambda entry: entry.order) if None in row else None
        return _Shared(
            parameters,
            {"": chosen_at, **sources},
            row,
            steps,
            position_settings,
            first.entry.source if first else None,
            mobility=mobility,
            node=read_struct("node", found, self._settings, path_of),
            wlan=wlan,
            autopilot=autopilot,
            idle_autopilot=autopilot_settings if autopilot is None else {},
        )

    def _position(
        self, found: Mapping[Key, Found], by_field: Mapping[str, Found], path_of: Callable[[Key], str]
    ) -> dict[str, Setting]:
        """What the entries say of where a node starts; those that are not in force are only checked."""
        idle = {field for axis in _AXES for field in _idle_fields(axis, by_field)}
        checked = {key: entry for key, entry in found.items() if key.field in idle}
        others = {key: entry for key, entry in found.items() if key.field not in idle}
        return {
            **(read_struct("position", checked, self._settings.for_checks(), path_of) if checked else {}),
            **read_struct("position", others, self._settings, path_of),
        }


def _with_mappings_of(other: _Shared, made: _Shared) -> _Shared:
    """The same for a node with the same entries in force, sharing what is equal in both."""
    return replace(
        made,
        protocol_sources=other.protocol_sources,
        mobility=other.mobility if other.mobility == made.mobility else made.mobility,
        node=other.node if other.node == made.node else made.node,
    )


def _grid_entries(axis: str, found: Mapping[str, Found]) -> list[Found]:
    """The entries that place nodes in a grid along an axis."""
    if axis not in AXES_OF_GRID:
        return []
    fields = (STATIC_GRID, *(field.format(axis) for field in GRID_FIELDS))
    return [entry for field in fields if (entry := found.get(field)) and not entry.is_default]


def _idle_fields(axis: str, found: Mapping[str, Found]) -> set[str]:
    """The fields that say nothing of where nodes start on an axis, as others are in force there."""
    initial, row = {f"initial_{axis}"}, {f"line_start_{axis}", f"line_step_{axis}"}
    grid = {field.format(axis) for field in GRID_FIELDS if "{" in field}
    orders = {field: entry.order for field, entry in found.items() if field in initial | row}
    if _axis_row(axis, found, {}) is None:
        return initial | row
    return grid | (row if orders and min(orders, key=orders.__getitem__) in initial else initial)


def _axis_row(
    axis: str, found: Mapping[str, Found], values: Mapping[str, float]
) -> tuple[float, float] | None:
    """Start and step along one axis in metres; None in a grid. Of all three the first entry is in force."""
    initial = found.get(f"initial_{axis}")
    row = [entry.order for field in ("start", "step") if (entry := found.get(f"line_{field}_{axis}"))]
    grid = [entry.order for entry in _grid_entries(axis, found)]
    if grid and all(min(grid) < order for order in (*row, *([initial.order] if initial else ()))):
        return None
    if initial is not None and all(initial.order < order for order in row):
        return values.get(f"initial_{axis}", 0.0), 0.0
    return values.get(f"line_start_{axis}", 0.0), values.get(f"line_step_{axis}", 0.0)


def _coordinate(node: str, index: int, axis: str, row: tuple[float, float], step: Found | None) -> float:
    """Where a node starts on one axis in metres. Raises ConfigError if its step leads too far."""
    coordinate = row[0] + index * row[1]
    if step is not None and not abs(coordinate) <= LARGEST_COORDINATE_M:
        text = (
            f"{node} starts at {axis} = {coordinate:.12g}m; expected at most {LARGEST_COORDINATE_M}m from 0m"
        )
        raise ConfigError.at(step.entry.source, text)
    return coordinate


def _load_class(found: Found, settings: SettingReader, loader: ProtocolLoader) -> ChosenProtocol:
    entry = found.entry
    reference = str(settings.scalar(entry, PROTOCOL_CLASS.kind))
    folder = entry.source.file.parent
    try:
        return ChosenProtocol(loader.load(reference, folder), entry.source, loader.files(reference, folder))
    except BadValue as error:
        expected = f"; expected {error.expected}" if error.expected else ""
        raise ConfigError.at(entry.source, f"{error.problem}{expected}{error.suggestion}") from error


def _native_class(found: Found, settings: SettingReader, _: ProtocolLoader) -> ChosenProtocol:
    entry = found.entry
    try:
        cls = native_protocol(str(settings.scalar(entry, PROTOCOL_TYPENAME.kind)))
        return ChosenProtocol(cls, entry.source)
    except BadValue as error:
        text = f"{error.problem}; expected one that `gradysim keys protocol` lists{error.suggestion}"
        raise ConfigError.at(entry.source, text) from error


def _misspelt_class_error(lookup: Lookup, group: Group, node: str) -> ConfigError | None:
    """The error about the line that was meant to say it; None if there is none."""
    for found in lookup.found:
        meant = _without_index(found, group, lookup.network)
        name, rest = found.name_pattern(), found.rest_pattern()
        if meant is None and name is not None and (name.matches(node) or name.matches(group.name)):
            meant = PROTOCOL_CLASS if is_misspelt_class(rest) else None
        if meant is not None:
            expected = f"`*.{group.written}.{meant.path}`"
            problem = f"`{found.entry.key}` matches no parameter, and nothing says which protocol {node} runs"
            return ConfigError(f"{problem}; expected {expected}", found.entry.source)
    return None


def _without_index(found: Found, group: Group, network: str) -> Key | None:
    """The key by which an entry says what the nodes of a group run, but for `[*]` after the group's name."""
    if found.is_default or group.written == group.name:
        return None
    matches = found.pattern.matches
    return next((key for key in PROTOCOL_KEYS if matches(f"{network}.{group.name}.{key.path}")), None)


def _no_class_error(group: Group, groups: list[Group], node: str) -> ConfigError:
    keys = {other.name: other.size_key for other in groups if other is not group and other.size is not None}
    match = nearest(group.name, keys)
    hint = f"; did you mean `*.{keys[match]}`?" if match else ""
    expected = f'`*.{group.written}.protocol.class = "file.py:Class"`'
    source = group.size_found.entry.source if group.size_found else None
    return ConfigError(f"nothing says which protocol {node} runs; expected {expected}{hint}", source)
