"""Explains a parameter of a run: its value, the line that sets it, the lines it hides, and its readers."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from gradysim.scenario.errors import ConfigError, Source, nearest
from gradysim.scenario.lint import INSTEAD_WITH_POWERS, keys_instead
from gradysim.scenario.parse.functions import text_of
from gradysim.scenario.resolve.lines import Line, Row, Rows
from gradysim.scenario.resolve.models import Models, unmet_choice
from gradysim.scenario.resolve.resolution import Resolution, network_schemas, node_schema, protocol_schema
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.engine_keys import Key, ReadBy
from gradysim.scenario.schema.keys import (
    BAND_NAME,
    CHANNEL_NUMBER,
    GROUP_SIZE,
    GROUP_SIZE_OF_NODES,
    KEYS_BY_TARGET,
    NETWORK_MODULES,
    PROTOCOL_KEYS,
    index_of_interface,
)
from gradysim.scenario.schema.native_protocols import NativeProtocol
from gradysim.scenario.schema.options import OPTION_KEYS
from gradysim.scenario.schema.values import SettingReader


@dataclass(frozen=True)
class Explanation:
    """What is known about one parameter of a run.

    Attributes:
        name: Its path below the network, or the name of an option.
        value: Its value in this run, as a file would have it; the default if no line sets it.
        sources: The lines that match. The first is in force, unless there is none, and hides the others.
        default: The default, as a file would have it.
        meaning: What it is.
        read_by: The models that read it, or the protocol; empty if all models do.
        lacking: What would have to be chosen for it to be read; None if it is read.
        chosen: What is chosen instead.
        instead: A line with another key that sets the same thing before; this value has no effect then.
    """

    name: str
    value: str
    sources: tuple[Source, ...]
    default: str
    meaning: str
    read_by: tuple[str, ...] = ()
    lacking: ReadBy | None = None
    chosen: str = ""
    instead: Source | None = None


def explain(scenario: Scenario, parameter: str) -> Explanation:
    """Explain a parameter of a scenario that `load_scenarios` has returned in this process.

    `parameter` is a path such as `uavs[3].mobility.speed`, with or without `*.` or the network's name before
    it, or an option. Raises ConfigError if there is none of that name.
    """
    resolution = scenario.resolution
    assert resolution is not None
    name = parameter.removeprefix("**.").removeprefix("*.").removeprefix(f"{resolution.lines.network}.")
    if "." not in name and name not in _sizes(resolution):
        return _of_option(scenario, name)
    row, node = _row_of(resolution, name, parameter)
    models = Models(resolution, SettingReader(scenario.seed))
    placed = models.placed(row, node)
    lacking = unmet_choice(placed.target, placed.chosen)
    known = KEYS_BY_TARGET.get(placed.target)
    default = _default(row, resolution, models, node)
    return Explanation(
        name,
        _value(row, SettingReader(scenario.seed), name, default),
        tuple(line.entry.source for line in row.lines),
        default,
        _meaning(row.key, resolution, node),
        _readers(known, resolution, node),
        lacking,
        (placed.chosen(lacking.chosen_by) or "") if lacking else "",
        _instead(row, resolution.kinds[node].rows if node else {}),
    )


def _instead(row: Row, rows: Rows) -> Source | None:
    """Return a line that sets the same thing by another key, and comes first."""
    others = [rows[path] for path in keys_instead(row.path, INSTEAD_WITH_POWERS) if path in rows]
    lines = [line for other in others if (line := _in_force(other.lines))]
    first = min(lines, key=lambda line: line.order, default=None)
    if first is None or (row.lines and row.line.order < first.order):
        return None
    return first.entry.source


def _meaning(key: Key, resolution: Resolution, node: str) -> str:
    if not _is_parameter(key):
        return key.meaning
    cls = resolution.kinds[node].protocol.cls
    declared = cls._parameters.get(key.field) if issubclass(cls, NativeProtocol) else None
    return declared.meaning if declared else f"Attribute of {cls.__name__}"


def _readers(key: Key | None, resolution: Resolution, node: str) -> tuple[str, ...]:
    """Return the models that read a parameter, or its protocol."""
    if key is None:
        return (resolution.kinds[node].protocol.cls.__name__,) if node else ()
    return key.read_by.names if key.read_by else ()


def _is_parameter(key: Key) -> bool:
    return key.struct == "protocol" and key not in PROTOCOL_KEYS


def _sizes(resolution: Resolution) -> Mapping[str, Row]:
    """Return the rows of the numbers of nodes, by their keys below the network."""
    rows = [(group, group.size_row or Row(GROUP_SIZE, "")) for group in resolution.groups]
    return {group.size_key: row for group, row in rows} | {f"{group.name}.count": row for group, row in rows}


def _of_option(scenario: Scenario, name: str) -> Explanation:
    key = next((key for key in OPTION_KEYS if key.path == name), None)
    if key is None:
        names = [key.path for key in OPTION_KEYS]
        problem, expected = (
            f"there is no option `{name}`",
            "an option, or a path such as `uavs[0].mobility.speed`",
        )
        raise ConfigError(problem, expected=expected, suggestion=nearest(name, names))
    entries = [entry for entry in scenario.entries if entry.key == name]
    is_set = bool(entries) and entries[0].text != "default"
    value = entries[0].text if is_set else key.default_text
    return Explanation(name, value, tuple(entry.source for entry in entries), key.default_text, key.meaning)


def _row_of(resolution: Resolution, name: str, written: str) -> tuple[Row, str]:
    """Return the row of a parameter, which has no lines if it has its default, and its node, or ""."""
    if row := _sizes(resolution).get(name):
        return row._replace(key=GROUP_SIZE_OF_NODES), ""
    subject, _, rest = name.partition(".")
    if subject in NETWORK_MODULES:
        schema = network_schemas(resolution.obstacle_count)[subject]
        row = resolution.of_network.get(name)
        return row or _without_lines(schema.keys, rest, subject, written)._replace(path=name), ""
    kind = resolution.kinds.get(subject)
    if kind is None:
        groups = {group.name: group for group in resolution.groups}
        group = groups.get(subject.partition("[")[0])
        of_group = group.node_names()[:1] if group else []
        example = of_group or list(resolution.kinds)[:1]
        names = [] if of_group else [*resolution.kinds, *NETWORK_MODULES]
        raise ConfigError(
            f"`{written}` names neither a node nor a part of the network",
            expected=f"a path such as `{example[0]}.{rest}`",
            suggestion=f"{match}.{rest}" if (match := nearest(subject, names)) else "",
        )
    keys = {**node_schema(kind.interface_count).keys, **protocol_schema(kind.protocol.cls).keys}
    return kind.rows.get(rest) or _without_lines(keys, rest, subject, written), subject


def _without_lines(keys: Mapping[str, Key], path: str, subject: str, written: str) -> Row:
    if path not in keys:
        match = nearest(path, keys)
        raise ConfigError(
            f"`{written}` names no parameter of {subject}",
            expected="one that `gradysim keys` lists",
            suggestion=f"{subject}.{match}" if match else "",
        )
    return Row(keys[path], path)


def _default(row: Row, resolution: Resolution, models: Models, node: str) -> str:
    key = row.key
    if _is_parameter(key):
        value = getattr(resolution.kinds[node].protocol.cls, key.field)
        return f'"{value}"' if isinstance(value, str) else text_of(value)
    if not key.defaults:
        return key.default_text
    return key.kind.show(models.default(key, node, index_of_interface(row.path)))


def _value(row: Row, settings: SettingReader, path: str, default: str) -> str:
    """Return the value in the unit of the key; a text, a file, a list or a channel as it is written."""
    line = _in_force(row.lines)
    if line is None:
        return default
    kind = row.key.kind
    is_as_written = kind.is_text or kind.is_file or kind.is_list or row.key in (BAND_NAME, CHANNEL_NUMBER)
    if is_as_written and not line.differs:
        return line.entry.text
    return kind.show(settings.scalar(line.entry, kind, path))


def _in_force(lines: Iterable[Line]) -> Line | None:
    """Return the line that sets a value; None if there is none, or if it says `default`."""
    line = next(iter(lines), None)
    return None if line is None or line.is_default else line
