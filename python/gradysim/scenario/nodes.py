"""Builds the nodes of a scenario from the entries in force for each of them.

Nodes with the same entries in force share the mappings made from them, so a thousand such nodes cost little
more than one.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.position import LARGEST_COORDINATE_M, Position
from gradysim.scenario.errors import BadValue, ConfigError, ErrorCollector, Source, nearest
from gradysim.scenario.groups import Group
from gradysim.scenario.interfaces import InterfaceBuilder
from gradysim.scenario.keys import (
    MASSLESS,
    MOBILITY_KEYS,
    NODE_KEYS,
    PROTOCOL_CLASS,
    PROTOCOL_KEYS,
    PROTOCOL_TYPENAME,
    QUADCOPTER,
    STATIC_GRID,
    STATIONARY,
    WLAN_KEYS,
)
from gradysim.scenario.lookup import Candidates, Found, Lookup, Setting, SettingReader, read_struct
from gradysim.scenario.native_protocols import native_protocol
from gradysim.scenario.node_spec import AutopilotSpec, InterfaceSpec, NodeSpec, read_autopilot
from gradysim.scenario.parameter_types import ParameterType
from gradysim.scenario.parameters import parameters_of
from gradysim.scenario.paths import path_of
from gradysim.scenario.placement import AXES, Grid, axis_row, first_of_grid, idle_fields, read_grid
from gradysim.scenario.protocols import ProtocolLoader
from gradysim.scenario.schema import Key
from gradysim.scenario.unknown_keys import is_misspelled_class

_TYPENAME = next(key for key in MOBILITY_KEYS if key.target == "mobility.typename")
_NO_GRID = Grid(1, (0.0, 0.0), (0.0, 0.0))


@dataclass(frozen=True, eq=False)
class _Shared:
    """What nodes with the same entries in force have in common.

    Attributes:
        row: Start and step in meters for each axis, or None on an axis of a grid.
        steps: The entries of the steps.
        grid_settings: Settings of the grid. Its size also depends on the group.
        grid_line: The place that asks for the grid, or None.
    """

    protocol_parameters: Mapping[str, object]
    protocol_sources: Mapping[str, Source]
    row: tuple[tuple[float, float] | None, ...]
    steps: tuple[Found | None, ...]
    grid_settings: Mapping[str, Setting]
    grid_line: Source | None
    mobility: Mapping[str, Setting]
    node: Mapping[str, Setting]
    computer: Mapping[str, Setting]
    wlan: tuple[InterfaceSpec, ...]
    autopilot: AutopilotSpec | None
    idle_autopilot: Mapping[str, Setting]


@dataclass(frozen=True, eq=False)
class ChosenProtocol:
    """The protocol of some nodes, the line that chooses it, and its files."""

    cls: type[IProtocol]
    source: Source
    files: tuple[Path, ...] = ()


def load_protocols(
    lookup: Lookup,
    groups: list[Group],
    settings: SettingReader,
    loader: ProtocolLoader,
    errors: ErrorCollector,
) -> dict[str, ChosenProtocol]:
    """Return the protocol of each node, by name.

    Groups with a node that has no protocol, or one that does not load, are left out. `errors` takes the
    reason. Missing protocols are not reported after other errors, as they often follow from a wrong name.
    """
    has_errors = bool(errors.errors)
    candidates = [(key, lookup.candidates(key.path)) for key in PROTOCOL_KEYS]
    protocols: dict[str, ChosenProtocol] = {}
    by_entry: dict[Found, ChosenProtocol] = {}

    def of_node(group: Group, name: str) -> ChosenProtocol:
        given = [
            (found.order, key, found)
            for key, of_key in candidates
            if (found := of_key.first(name)) is not None and not found.is_default
        ]
        if not given:
            error = _misspelled_class_error(lookup, group, name)
            raise error or _no_class_error(group, groups, name)
        _, key, found = min(given, key=lambda each: each[0])
        if found not in by_entry:
            load = _load_class if key is PROTOCOL_CLASS else _native_class
            by_entry[found] = load(found, settings, loader)
        return by_entry[found]

    for group in groups:
        try:
            protocols |= {name: of_node(group, name) for name in group.node_names()}
        except _MissingProtocolError as error:
            if not has_errors:
                errors.add(error)
        except ConfigError as error:
            errors.add(error)
    return protocols


class _MissingProtocolError(ConfigError):
    """Nothing says which protocol a node runs."""


def build_nodes(
    lookup: Lookup,
    groups: list[Group],
    protocols: Mapping[str, ChosenProtocol],
    interface_counts: Mapping[str, int],
    settings: SettingReader,
    errors: ErrorCollector,
) -> tuple[NodeSpec, ...]:
    """Return all nodes with a protocol, in the order of their ids. `errors` takes the errors of values."""
    builder = _NodeBuilder(lookup, settings, errors)
    nodes: list[NodeSpec] = []
    for group in groups:
        for index, name in enumerate(group.node_names()):
            if name not in protocols:
                break
            shared = builder.shared(name, protocols[name], interface_counts[name])
            grid = builder.grid(shared, group)
            x, y, z = (
                builder.coordinate_m(name, index, axis, row, step)
                if row is not None
                else grid.coordinate_m(index, axis)
                for axis, row, step in zip(AXES, shared.row, shared.steps, strict=True)
            )
            place = builder.start(shared.mobility, (x, y, z))
            nodes.append(
                NodeSpec(
                    id=len(nodes),
                    name=name,
                    group=group.name,
                    index=index,
                    protocol=protocols[name].cls,
                    protocol_parameters=shared.protocol_parameters,
                    initial_position=place,
                    mobility=shared.mobility,
                    wlan=shared.wlan,
                    protocol_sources=shared.protocol_sources,
                    node=shared.node,
                    computer=shared.computer,
                    autopilot=shared.autopilot,
                    idle_autopilot=shared.idle_autopilot,
                )
            )
    return tuple(nodes)


class _NodeBuilder:
    def __init__(self, lookup: Lookup, settings: SettingReader, errors: ErrorCollector) -> None:
        self._lookup = lookup
        self._settings = settings
        self._errors = errors
        self._keys = [
            (key, candidates)
            for key in NODE_KEYS
            if key not in (*PROTOCOL_KEYS, *WLAN_KEYS) and (candidates := lookup.candidates(key.path))
        ]
        self._parameters: dict[type[IProtocol], list[tuple[str, ParameterType, Candidates]]] = {}
        self._interfaces = InterfaceBuilder(lookup, settings, errors)
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
                self._parameter_settings(name, parameters, found_parameters),
            )
            shared = _with_mappings_of(shared, made) if shared else made
            self._shared[in_force] = shared
        return shared

    def _parameter_settings(
        self,
        name: str,
        parameters: Sequence[tuple[str, ParameterType, Candidates]],
        found: Sequence[Found | None],
    ) -> dict[str, Setting]:
        read: dict[str, Setting] = {}
        for (parameter, kind, _), entry in zip(parameters, found, strict=True):
            if entry and not entry.is_default:
                with self._errors.collecting():
                    path = f"{name}.protocol.{parameter}"
                    read[parameter] = self._settings.setting(entry.entry, kind, path)
        return read

    def grid(self, shared: _Shared, group: Group) -> Grid:
        """Return the grid of those nodes of a group; an empty one if they are not in a grid."""
        if shared.grid_line is None:
            return _NO_GRID
        grid = self._grids.get((shared, group.name))
        if grid is None:
            grid = _NO_GRID
            with self._errors.collecting():
                grid = read_grid(shared.grid_settings, group, shared.grid_line)
            self._grids[shared, group.name] = grid
        return grid

    def coordinate_m(
        self, node: str, index: int, axis: str, row: tuple[float, float], step: Found | None
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

        mobility = read_struct("mobility", found, self._settings, path_of, self._errors)
        typename = mobility.get("typename")
        is_static_grid = typename is not None and typename.value == STATIC_GRID
        if is_static_grid:
            mobility["typename"] = replace(mobility["typename"], value=STATIONARY)
            position[STATIC_GRID] = found[_TYPENAME]
        error_count = len(self._errors.errors)
        position_settings = self._position(found, position, path_of)
        has_position = len(self._errors.errors) == error_count
        values = {field: float(setting.value) for field, setting in position_settings.items()}
        autopilot_settings = read_struct("autopilot", found, self._settings, path_of, self._errors)
        autopilot = None
        with self._errors.collecting():
            autopilot = read_autopilot(mobility, autopilot_settings)
        if autopilot is not None:
            mobility["typename"] = replace(mobility["typename"], value=MASSLESS)
        row = tuple(axis_row(axis, position, values) for axis in AXES)
        steps = tuple(position.get(f"line_step_{axis}") for axis in AXES)
        return _Shared(
            parameters,
            {"": chosen_at, **sources},
            row,
            steps,
            position_settings,
            first_of_grid(position) if has_position else None,
            mobility=mobility,
            node=read_struct("node", found, self._settings, path_of, self._errors),
            computer=read_struct("computer", found, self._settings, path_of, self._errors),
            wlan=wlan,
            autopilot=autopilot,
            idle_autopilot=autopilot_settings if autopilot is None else {},
        )

    def _position(
        self, found: Mapping[Key, Found], by_field: Mapping[str, Found], path_of: Callable[[Key], str]
    ) -> dict[str, Setting]:
        """Read the settings of a node's initial position; those that are not in force are only checked."""
        idle = idle_fields(by_field)
        checked = {key: entry for key, entry in found.items() if key.field in idle}
        others = {key: entry for key, entry in found.items() if key.field not in idle}
        settings: dict[str, Setting] = {}
        if checked:
            settings = read_struct("position", checked, self._settings.for_checks(), path_of, self._errors)
        return settings | read_struct("position", others, self._settings, path_of, self._errors)


def _with_mappings_of(other: _Shared, made: _Shared) -> _Shared:
    """Return `made` with the mappings of `other` where they are equal."""
    return replace(
        made,
        protocol_sources=other.protocol_sources,
        mobility=other.mobility if other.mobility == made.mobility else made.mobility,
        node=other.node if other.node == made.node else made.node,
        computer=other.computer if other.computer == made.computer else made.computer,
    )


def _load_class(found: Found, settings: SettingReader, loader: ProtocolLoader) -> ChosenProtocol:
    entry = found.entry
    reference = str(settings.scalar(entry, PROTOCOL_CLASS.kind))
    folder = entry.source.file.parent
    try:
        return ChosenProtocol(loader.load(reference, folder), entry.source, loader.files(reference, folder))
    except BadValue as error:
        raise error.at(entry.source) from error


def _native_class(found: Found, settings: SettingReader, _: ProtocolLoader) -> ChosenProtocol:
    entry = found.entry
    try:
        cls = native_protocol(str(settings.scalar(entry, PROTOCOL_TYPENAME.kind)))
        return ChosenProtocol(cls, entry.source)
    except BadValue as error:
        raise error.at(entry.source, expected="one that `gradysim keys protocol` lists") from error


def _misspelled_class_error(lookup: Lookup, group: Group, node: str) -> ConfigError | None:
    """Return the error for the line that was meant to set the protocol; None if there is none."""
    for found in lookup.found:
        meant = _without_index(found, group, lookup.network)
        name, rest = found.name_pattern(), found.rest_pattern()
        if meant is None and name is not None and (name.matches(node) or name.matches(group.name)):
            meant = PROTOCOL_CLASS if is_misspelled_class(rest) else None
        if meant is not None:
            return _MissingProtocolError(
                f"`{found.entry.key}` matches no parameter, and nothing says which protocol {node} runs",
                found.entry.source,
                expected=f"`*.{group.written}.{meant.path}`",
            )
    return None


def _without_index(found: Found, group: Group, network: str) -> Key | None:
    """Return the key that an entry would set if it had `[*]` after the group's name."""
    if found.is_default or group.written == group.name:
        return None
    matches = found.pattern.matches
    return next((key for key in PROTOCOL_KEYS if matches(f"{network}.{group.name}.{key.path}")), None)


def _no_class_error(group: Group, groups: list[Group], node: str) -> ConfigError:
    keys = {other.name: other.size_key for other in groups if other is not group and other.size is not None}
    match = nearest(group.name, keys)
    return _MissingProtocolError(
        f"nothing says which protocol {node} runs",
        group.size_found.entry.source if group.size_found else None,
        expected=f'`*.{group.written}.protocol.class = "file.py:Class"`',
        suggestion=f"*.{keys[match]}" if match else "",
    )
