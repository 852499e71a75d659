"""Resolves a run: which line sets which parameter of which subject, and which lines that hides.

Subjects are the nodes, the groups and the network. Which parameters there are depends on some values: the
sizes of groups, the protocols of nodes, the numbers of interfaces and obstacles. So these are read here. All
other values are read by the modules that build the scenario.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property, lru_cache
from pathlib import Path

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.errors import BadValue, ConfigError, ErrorCollector, Source, nearest
from gradysim.scenario.parse.patterns import Pattern
from gradysim.scenario.resolve.groups import Group
from gradysim.scenario.resolve.lines import Line, Lines, Row, Rows, Schema
from gradysim.scenario.schema.engine_keys import Key
from gradysim.scenario.schema.keys import (
    NETWORK_KEYS,
    NODE_KEYS,
    NUM_OBSTACLES,
    NUM_WLAN_INTERFACES,
    OBSTACLE_KEYS,
    PROTOCOL_CLASS,
    PROTOCOL_KEYS,
    WLAN_KEYS,
    at_interface,
    obstacle_path,
)
from gradysim.scenario.schema.native_protocols import native_protocol
from gradysim.scenario.schema.parameters import parameters_of
from gradysim.scenario.schema.protocols import ProtocolLoader
from gradysim.scenario.schema.values import SettingReader


@dataclass(frozen=True, eq=False)
class ChosenProtocol:
    """The protocol of some nodes, the line that chooses it, and its files."""

    cls: type[IProtocol]
    source: Source
    files: tuple[Path, ...] = ()


@dataclass(frozen=True, eq=False)
class NodeKind:
    """Nodes that the same lines are about.

    Attributes:
        protocol: What they run.
        interface_count: The number of their network interfaces.
        rows: The rows of their parameters.
    """

    protocol: ChosenProtocol
    interface_count: int
    rows: Rows

    @cached_property
    def by_struct(self) -> Mapping[str, Sequence[Row]]:
        """The rows by the struct of their key."""
        rows: dict[str, list[Row]] = {}
        for row in self.rows.values():
            rows.setdefault(row.key.struct, []).append(row)
        return rows

    @cached_property
    def differing(self) -> frozenset[str]:
        """The structs with values that differ between the nodes: they are drawn, or depend on an index."""
        rows = self.rows.values()
        return frozenset(row.key.struct for row in rows if row.line.differs)


@dataclass(frozen=True, eq=False)
class Resolution:
    """All rows of a run. Those of a million equal nodes are there once.

    Attributes:
        lines: The lines.
        groups: The groups, in the order of the ids of their nodes.
        kinds: The kind of each node, by its name. Nodes without a protocol are left out.
        of_network: The rows of parameters of the network, by path below it.
        of_absent: The rows that a first node of a group without nodes would have.
        obstacle_count: The number of obstacles that have keys.
    """

    lines: Lines
    groups: list[Group]
    kinds: Mapping[str, NodeKind]
    of_network: Rows
    of_absent: list[Rows]
    obstacle_count: int

    def rows(self) -> Iterator[Row]:
        """Yield each row once."""
        yield from (group.size_row for group in self.groups if group.size_row is not None)
        for rows in {id(kind.rows): kind.rows for kind in self.kinds.values()}.values():
            yield from rows.values()
        yield from self.of_network.values()
        for rows in self.of_absent:
            yield from rows.values()

    def matched(self) -> set[Line]:
        """Return the lines that are about some parameter."""
        parts = {id(part.own): part.own for row in self.rows() for part in (row, row.general) if part}
        return {line for lines in parts.values() for line in lines}


_CHOICES = Schema({key.path: key for key in (*PROTOCOL_KEYS, NUM_WLAN_INTERFACES)})
"""The parameters that decide which others a node has."""


@lru_cache(maxsize=2)  # without obstacles, and with those of a study
def network_schemas(obstacles: int = 0) -> Mapping[str, Schema]:
    """Return the schema of each module of the network, by name."""
    paths = [(key.path, key) for key in NETWORK_KEYS if key not in OBSTACLE_KEYS]
    paths += [(obstacle_path(key, index), key) for index in range(obstacles) for key in OBSTACLE_KEYS]
    modules: dict[str, dict[str, Key]] = {}
    for path, key in paths:
        module, rest = path.split(".", 1)
        modules.setdefault(module, {})[rest] = key
    return {module: Schema(keys) for module, keys in modules.items()}


@cache
def node_schema(interfaces: int) -> Schema:
    """Return the schema of nodes, without the parameters of their protocols."""
    keys = {key.path: key for key in NODE_KEYS}
    keys |= {at_interface(key.path, index): key for index in range(1, interfaces) for key in WLAN_KEYS}
    return Schema(keys)


def protocol_schema(cls: type[IProtocol]) -> Schema:
    """Return the schema of the parameters of a protocol."""
    paths = {f"protocol.{name}": kind for name, kind in parameters_of(cls).items()}
    return Schema({path: Key(path, path, kind, "") for path, kind in paths.items()})


def resolve(
    lines: Lines, groups: list[Group], settings: SettingReader, loader: ProtocolLoader, errors: ErrorCollector
) -> Resolution:
    """Return the rows of a run.

    Groups with a node that has no protocol, or one that does not load, have no rows. `errors` takes the
    reason, and the errors of the values that are read. Missing protocols are not reported after other errors,
    as they often follow from a wrong name.
    """
    kinds = _NodeKinds(lines, groups, settings, loader, errors).by_name()
    obstacles = _obstacle_count(lines, settings, errors) if kinds else 0
    of_network = {
        f"{module}.{path}": row._replace(path=f"{module}.{path}")
        for module, schema in network_schemas(obstacles).items()
        for path, row in lines.rows(lines.names(module), schema).items()
    }
    of_absent = [
        lines.rows(lines.names(f"{group.name}[0]"), node_schema(1)) for group in groups if group.size == 0
    ]
    return Resolution(lines, groups, kinds, of_network, of_absent, obstacles)


def _obstacle_count(lines: Lines, settings: SettingReader, errors: ErrorCollector) -> int:
    """Return `environment.numObstacles`. `errors` takes the error of a bad number, which counts as 0."""
    module, path = NUM_OBSTACLES.path.split(".", 1)
    row = lines.rows(lines.names(module), network_schemas()[module]).get(path)
    if row is not None and not row.line.is_default:
        with errors.collecting():
            return int(settings.scalar(row.line.entry, NUM_OBSTACLES.kind, NUM_OBSTACLES.path))
    return 0


class _MissingProtocolError(ConfigError):
    """Nothing says which protocol a node runs."""


class _NodeKinds:
    """Finds the kinds of all nodes. Each line that chooses a protocol is read once."""

    def __init__(
        self,
        lines: Lines,
        groups: list[Group],
        settings: SettingReader,
        loader: ProtocolLoader,
        errors: ErrorCollector,
    ) -> None:
        self._lines = lines
        self._groups = groups
        self._settings = settings
        self._loader = loader
        self._errors = errors
        self._protocols: dict[Line, ChosenProtocol] = {}
        self._of_protocols: dict[type[IProtocol], Schema] = {}
        self._known: dict[object, NodeKind] = {}

    def by_name(self) -> dict[str, NodeKind]:
        """Return the kind of each node, by name."""
        has_errors = bool(self._errors.errors)
        protocols: dict[str, ChosenProtocol] = {}
        for group in self._groups:
            try:
                protocols |= {name: self._protocol(group, name) for name in group.node_names()}
            except _MissingProtocolError as error:
                if not has_errors:
                    self._errors.add(error)
            except ConfigError as error:
                self._errors.add(error)
        return {name: self._kind(name, protocol) for name, protocol in protocols.items()}

    def _choices(self, name: str) -> Rows:
        return self._lines.rows(self._lines.names(name), _CHOICES)

    def _protocol(self, group: Group, name: str) -> ChosenProtocol:
        """Return the protocol of a node. Raises ConfigError if there is none, or if it does not load."""
        choices = self._choices(name)
        given = [row for key in PROTOCOL_KEYS if (row := choices.get(key.path)) and not row.line.is_default]
        if not given:
            error = _misspelled_class_error(self._lines, group, name)
            raise error or _no_class_error(group, self._groups, name)
        row = min(given, key=lambda row: row.line.order)
        if row.line not in self._protocols:
            load = self._load_class if row.key is PROTOCOL_CLASS else self._native_class
            self._protocols[row.line] = load(row)
        return self._protocols[row.line]

    def _load_class(self, row: Row) -> ChosenProtocol:
        source = row.line.entry.source
        reference, folder = str(self._settings.scalar(row.line.entry, row.key.kind)), source.file.parent
        try:
            cls = self._loader.load(reference, folder)
            return ChosenProtocol(cls, source, self._loader.files(reference, folder))
        except BadValue as error:
            raise error.at(source) from error

    def _native_class(self, row: Row) -> ChosenProtocol:
        source = row.line.entry.source
        try:
            return ChosenProtocol(
                native_protocol(str(self._settings.scalar(row.line.entry, row.key.kind))), source
            )
        except BadValue as error:
            raise error.at(source, expected="one that `gradysim keys protocol` lists") from error

    def _kind(self, name: str, protocol: ChosenProtocol) -> NodeKind:
        names, count = self._lines.names(name), self._interface_count(name)
        kind = self._known.get((names, protocol, count))
        if kind is None:
            of_protocol = self._of_protocols.get(protocol.cls)
            if of_protocol is None:
                of_protocol = self._of_protocols[protocol.cls] = protocol_schema(protocol.cls)
            rows = dict(self._lines.rows(names, node_schema(count)))
            rows |= self._lines.rows(names, of_protocol)
            kind = self._known[names, protocol, count] = NodeKind(protocol, count, rows)
        return kind

    def _interface_count(self, name: str) -> int:
        """Return the number of interfaces of a node. `errors` takes the error of a bad number."""
        row = self._choices(name).get(NUM_WLAN_INTERFACES.path)
        if row is not None and not row.line.is_default:
            with self._errors.collecting():
                return int(self._settings.scalar(row.line.entry, row.key.kind, f"{name}.{row.path}"))
        return 1


def is_misspelled_class(rest: Pattern | None) -> bool:
    """Return whether the rest of a key is a misspelled `protocol.class`."""
    if rest is None or rest.literal is None or rest.literal == PROTOCOL_CLASS.path:
        return False
    paths = [key.path for key in PROTOCOL_KEYS]
    return rest.literal == "protocol" or nearest(rest.literal, paths, strict=True) == PROTOCOL_CLASS.path


def _misspelled_class_error(lines: Lines, group: Group, node: str) -> ConfigError | None:
    """Return the error for the line that was meant to set the protocol; None if there is none."""
    for line in lines.all:
        meant = _without_index(line, group, lines.network)
        name, rest = line.name_pattern, line.rest_pattern
        if meant is None and name is not None and (name.matches(node) or name.matches(group.name)):
            meant = PROTOCOL_CLASS if is_misspelled_class(rest) else None
        if meant is not None:
            return _MissingProtocolError(
                f"`{line.entry.key}` matches no parameter, and nothing says which protocol {node} runs",
                line.entry.source,
                expected=f"`*.{group.written}.{meant.path}`",
            )
    return None


def _without_index(line: Line, group: Group, network: str) -> Key | None:
    """Return the key that a line would set if it had `[*]` after the group's name."""
    if line.is_default or group.written == group.name:
        return None
    matches = line.pattern.matches
    return next((key for key in PROTOCOL_KEYS if matches(f"{network}.{group.name}.{key.path}")), None)


def _no_class_error(group: Group, groups: list[Group], node: str) -> ConfigError:
    keys = {other.name: other.size_key for other in groups if other is not group and other.size is not None}
    match = nearest(group.name, keys)
    return _MissingProtocolError(
        f"nothing says which protocol {node} runs",
        group.size_line.entry.source if group.size_line else None,
        expected=f'`*.{group.written}.protocol.class = "file.py:Class"`',
        suggestion=f"*.{keys[match]}" if match else "",
    )
