"""The keys of fields of the engine, from the engine's own declarations, and the options of a run.

Each field is declared once, next to its struct in cpp/netsim/config. `make schema` writes the declarations to
schema.json, so that an installation without the compiled part knows all keys, too.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

from gradysim.scenario.parse.units import db_from_ratio
from gradysim.scenario.schema.parameter_types import (
    ParameterType,
    bitrates,
    boolean,
    choice,
    file_name,
    integer,
    level,
    number,
    number_in,
    power_ratio,
    powers_by_bitrate,
    quantity,
    whole_bytes,
)

HAS_TO_BE_GIVEN = "none: it has to be given"
"""The default of a key without which its model, or a run, does not work."""

FILE = Path(__file__).with_name("schema.json")


@dataclass(frozen=True)
class ReadBy:
    """The models that read a key, of those among which another key chooses.

    Attributes:
        chosen_by: The target of that other key.
        names: Its values with which this key is read.
        shown: How lists of keys name these models; "" where the path of the key says enough.
    """

    chosen_by: str
    names: tuple[str, ...]
    shown: str


@dataclass(frozen=True)
class Key:
    """One parameter that an .ini file may set.

    Attributes:
        path: Below the node, or below the network for NETWORK_KEYS.
        target: Target of the value, "struct.field". Of two keys with one target, the first match wins.
        kind: Type of the value.
        meaning: One sentence for lists of keys.
        default: Default as written in a file; "" for a key with `defaults`.
        read_by: Models that read it; None if all do.
        defaults: {variant: value} of a field of the engine; the variant "" is the usual one.
        effects: {effect: names with it} of the key that chooses a path loss.
    """

    path: str
    target: str
    kind: ParameterType
    meaning: str
    default: str = ""
    read_by: ReadBy | None = None
    defaults: Mapping[str, Any] = field(default_factory=dict, hash=False, compare=False)
    effects: Mapping[str, Sequence[str]] = field(default_factory=dict, hash=False, compare=False)

    @property
    def written(self) -> str:
        """The path as written in a pattern."""
        return self.path.replace("[0]", "[*]")

    @property
    def struct(self) -> str:
        """The first part of the target."""
        return self.target.partition(".")[0]

    @property
    def field(self) -> str:
        """The second part of the target."""
        return self.target.partition(".")[2]

    @property
    def default_text(self) -> str:
        """The default of each variant as it would be written: "-85dBm; 802.15.4: -100dBm"."""
        if self.default:
            return self.default
        texts = {name: self.kind.show(value) for name, value in self.defaults.items()}
        usual = texts.pop("")
        return "; ".join([usual, *(f"{name}: {text}" for name, text in texts.items() if text != usual)])


@cache
def engine_keys() -> Mapping[str, tuple[Key, ...]]:
    """Return the keys of the engine's fields, {struct: its keys in the order of their declarations}."""
    keys: dict[str, list[Key]] = {}
    for row in json.loads(FILE.read_text(encoding="utf-8")):
        read_by = row["read_by"]
        key = Key(
            path=row["key"],
            target=row["target"],
            kind=_kind(**row["type"]),
            meaning=row["meaning"],
            default="" if row["defaults"] else HAS_TO_BE_GIVEN,
            read_by=read_by and ReadBy(read_by["chosen_by"], tuple(read_by["names"]), read_by["shown"]),
            defaults=row["defaults"],
            effects=row.get("effects", {}),
        )
        if key.path:
            keys.setdefault(key.struct, []).append(key)
    return {struct: tuple(of_struct) for struct, of_struct in keys.items()}


def _kind(kind: str, **details: Any) -> ParameterType:
    """Return the type of a declaration: `kind` is its name in cpp/netsim/config/field.hpp."""
    match kind:
        case "quantity":
            return quantity(**details)
        case "level":
            return level(zero="at_least" in details)
        case "ratio":
            least = details["at_least"]
            return power_ratio(db_from_ratio(least)) if least > 0 else power_ratio()
        case "number":
            return number_in(details["unit"]) if "unit" in details else number(**details)
        case "integer":
            whole = {name: int(value) for name, value in details.items()}
            return integer(**whole)
        case "bytes":
            return whole_bytes(int(details["at_least"]), int(details["at_most"]))
        case "boolean":
            return boolean()
        case "name":
            return choice(*details["names"])
        case "file":
            return file_name()
        case "bitrates":
            return bitrates()
        case "powers_by_bitrate":
            return powers_by_bitrate()
    raise ValueError(f"schema.json has a type `{kind}` that {__name__} does not know")
