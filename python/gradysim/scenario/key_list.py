"""The list of all keys for people: unit, default and meaning, from the tables that files are read with."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase

from gradysim.scenario.errors import nearest
from gradysim.scenario.schema.engine_keys import Key
from gradysim.scenario.schema.keys import (
    GROUP_SIZE,
    GROUP_SIZE_OF_NODES,
    NETWORK_KEYS,
    NETWORK_MODULES,
    NODE_KEYS,
    PROTOCOL_KEYS,
    PROTOCOL_PARAMETER,
)
from gradysim.scenario.schema.native_protocols import NativeProtocol
from gradysim.scenario.schema.options import OPTION_KEYS
from gradysim.scenario.schema.parameters import parameters_of

_INDEX = re.compile(r"\[(?:\d+|\d*\.\.\d*)\]", re.ASCII)

_GROUP = re.compile(r"\*\.(\w+)(?:\[[^\]]*\])?\.", re.ASCII)
"""The beginning of a key of a group of nodes, or of a part of the network."""

_GROUP_SIZE = re.compile(r"(?:\*\*?\.)?num[A-Z]\w*", re.ASCII)
"""Matches keys that set the number of nodes of a group, or some other number."""

_PREFIXES = {GROUP_SIZE_OF_NODES: "*.", GROUP_SIZE: "*.nodes."}
"""Prefixes of the keys of a group that do not belong to its nodes."""


@dataclass(frozen=True)
class KeyRow:
    """One key: all strings as they are shown."""

    key: str
    unit: str
    default: str
    meaning: str


@dataclass(frozen=True)
class KeySection:
    """Keys below the same module."""

    title: str
    rows: tuple[KeyRow, ...]


def key_sections(natives: Iterable[type[NativeProtocol]] = ()) -> list[KeySection]:
    """Return all keys, with the parameters of `natives`, the engine's protocols."""
    node_keys = (GROUP_SIZE_OF_NODES, GROUP_SIZE, *PROTOCOL_KEYS, PROTOCOL_PARAMETER)
    node_keys += NODE_KEYS[len(PROTOCOL_KEYS) :]
    native_rows = tuple(row for protocol in natives for row in _native_rows(protocol))
    sections = [
        KeySection("Options of a run", _rows("", OPTION_KEYS)),
        KeySection("Of a group of nodes, or of one node", _rows("*.nodes[*].", node_keys)),
        KeySection("Of the network", _rows("*.", NETWORK_KEYS)),
    ]
    return (
        [*sections, KeySection("Of a node with a native protocol", native_rows)] if native_rows else sections
    )


def matching(sections: Iterable[KeySection], pattern: str) -> list[KeySection]:
    """Return the keys that match `pattern`, if it has a `*` or `?`; otherwise those that contain it.

    Values and meanings are searched, too. Case does not matter. Keys are listed for `nodes` and any index,
    `wlan[*]`. A pattern with an index, a range or another group, such as `*.uavs[0].mobility.speed` or
    `*.numUavs`, finds them there. If no key matches, keys with that prefix are listed.
    """
    everything = list(sections)
    wanted = (pattern, _group_as_nodes(pattern, key_meant(everything, pattern)))
    found = (_matching(everything, name + end) for end in ("", "*") for name in wanted)
    return next(filter(None, found), [])


def key_meant(sections: Iterable[KeySection], pattern: str) -> str:
    """Return the end of a message about a pattern without a match; "" without a typo."""
    keys = [row.key.partition(" ")[0].split(".") for section in sections for row in section.rows]
    meant = nearest(pattern, (".".join(key[-length:]) for length in (1, 2) for key in keys), strict=True)
    return f"; did you mean `{meant}`?" if meant else ""


def _matching(sections: Iterable[KeySection], pattern: str) -> list[KeySection]:
    wanted = _INDEX.sub("[*]", pattern.lower())
    is_pattern = bool(set("*?") & set(wanted.replace("[*]", "")))
    glob = wanted.replace("[", "[[]")

    def fits(row: KeyRow) -> bool:
        if is_pattern:
            return fnmatchcase(row.key.lower(), glob)
        return any(wanted in text.lower() for text in (row.key, row.unit, row.default, row.meaning))

    found = [replace(section, rows=tuple(filter(fits, section.rows))) for section in sections]
    return [section for section in found if section.rows]


def _group_as_nodes(pattern: str, meant: str) -> str:
    """Return the pattern for the group `nodes`; `meant` is the result of `key_meant`."""
    if _GROUP_SIZE.fullmatch(pattern) and (not meant or GROUP_SIZE_OF_NODES.path in meant):
        return f"{_PREFIXES[GROUP_SIZE_OF_NODES]}{GROUP_SIZE_OF_NODES.path}"
    group = _GROUP.match(pattern)
    if group is None or group[1] in NETWORK_MODULES:
        return pattern
    rest = pattern[group.end() :]
    return f"{_PREFIXES[GROUP_SIZE]}{rest}" if rest == GROUP_SIZE.path else f"*.nodes[*].{rest}"


def _rows(prefix: str, keys: Iterable[Key]) -> tuple[KeyRow, ...]:
    return tuple(
        KeyRow(f"{_PREFIXES.get(key, prefix)}{key.written}", key.kind.unit, key.default_text, _meaning(key))
        for key in keys
    )


def _native_rows(protocol: type[NativeProtocol]) -> Iterator[KeyRow]:
    """Yield the protocol itself, and its parameters."""
    same = f"the same as {protocol._python_class}" if protocol._python_class else ""
    yield KeyRow(f'*.nodes[*].protocol.typename = "{protocol.__name__}"', same, "", protocol._meaning)
    for name, kind in parameters_of(protocol).items():
        unit, meaning = protocol._parameters[name].unit, protocol._parameters[name].meaning
        value = getattr(protocol, name)
        is_quantity = isinstance(value, float)
        default = f"{value:g}{unit}" if is_quantity else kind.show(value)
        shown = unit or "number" if is_quantity else f"{kind.unit} of {unit}" if unit else kind.unit
        yield KeyRow(f"*.nodes[*].protocol.{name}", shown, default, meaning)


def _meaning(key: Key) -> str:
    """Return the meaning of a key, after the models that read it."""
    models = key.read_by.shown if key.read_by else ""
    return f"{models}: {key.meaning}" if models else key.meaning
