"""The list of all keys for people: unit, default and meaning, from the tables that files are read with."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase

from gradysim.config.keys import (
    GROUP_SIZE,
    NETWORK_KEYS,
    NODE_KEYS,
    OPTION_KEYS,
    PROTOCOL_PARAMETER,
    Key,
)
from gradysim.config.scenario import CommunicationMediumSpec

Structs = Mapping[str, Mapping[str, object]]
"""{struct: {variant: the struct with its defaults}}; the variant that is the default is called ""."""

UNKNOWN = "?"
"""Default of a key whose struct is not at hand."""

OWN_STRUCTS: Structs = {"communication_medium": {"": CommunicationMediumSpec()}}


@dataclass(frozen=True)
class KeyRow:
    """One key: all texts as they are shown."""

    key: str
    unit: str
    default: str
    meaning: str


@dataclass(frozen=True)
class KeySection:
    """Keys that are written below the same thing."""

    title: str
    rows: tuple[KeyRow, ...]


def key_sections(structs: Structs) -> list[KeySection]:
    """All keys. `structs` has the defaults of the engine's configurations; a struct may be missing."""
    known = {**structs, **OWN_STRUCTS}
    node_keys = (GROUP_SIZE, NODE_KEYS[0], PROTOCOL_PARAMETER, *NODE_KEYS[1:])
    return [
        KeySection("Options of a run", _rows("", OPTION_KEYS, known)),
        KeySection("Of a group of nodes, or of one node", _rows("*.nodes[*].", node_keys, known)),
        KeySection("Of the network", _rows("*.", NETWORK_KEYS, known)),
    ]


def matching(sections: Iterable[KeySection], pattern: str) -> list[KeySection]:
    """The keys that contain `pattern`, in any case, or match it if it has a `*` or `?`."""
    wanted = pattern.lower()
    if not set("*?") & set(wanted.replace("[*]", "")):
        wanted = f"*{wanted}*"
    wanted = wanted.replace("[", "[[]")
    found = [
        replace(section, rows=tuple(row for row in section.rows if fnmatchcase(row.key.lower(), wanted)))
        for section in sections
    ]
    return [section for section in found if section.rows]


def _rows(prefix: str, keys: Iterable[Key], structs: Structs) -> tuple[KeyRow, ...]:
    return tuple(
        KeyRow(f"{_prefix(prefix, key)}{key.written}", key.kind.unit, _default(key, structs), key.meaning)
        for key in keys
    )


def _prefix(prefix: str, key: Key) -> str:
    return prefix.replace("[*]", "") if key is GROUP_SIZE else prefix


def _default(key: Key, structs: Structs) -> str:
    if key.default:
        return key.default
    variants = structs.get(key.struct)
    if not variants:
        return UNKNOWN
    texts = {name: key.kind.show(getattr(struct, key.field)) for name, struct in variants.items()}
    default = texts.pop("")
    if key.field == "typename":
        return default
    return "; ".join([default, *(f"{name}: {text}" for name, text in texts.items() if text != default)])
