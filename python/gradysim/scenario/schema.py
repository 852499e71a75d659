"""The keys of fields of the engine, from the engine's own declarations, and the options of a run.

Each field is declared once, next to its struct in cpp/netsim/config. `make schema` writes the declarations to
schema.json, so that an installation without the compiled part knows all keys, too.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

from gradysim.scenario.parameter_types import (
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
    text,
    whole_bytes,
)
from gradysim.scenario.units import db_from_ratio

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
    """

    path: str
    target: str
    kind: ParameterType
    meaning: str
    default: str = ""
    read_by: ReadBy | None = None
    defaults: Mapping[str, Any] = field(default_factory=dict, hash=False, compare=False)

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


# Options of a run, and options that only OMNeT++ has. Of the latter, those that say how OMNeT++ runs, shows
# and records are ignored. Those that would make another run are refused.

LONGEST_RUN_S = 9_200_000
"""The engine's bound, SimTime::longest_run_s: its clock counts picoseconds in 64 bits. Both modes have it."""

LARGEST_SEED = 2**63 - 1
"""Of a run, in both modes."""


def _option(name: str, kind: ParameterType, meaning: str, default: str) -> Key:
    return Key(name, f"option.{name.replace('-', '_')}", kind, meaning, default)


OPTION_KEYS: tuple[Key, ...] = (
    _option(
        "sim-time-limit",
        quantity("s", above=0, at_most=LONGEST_RUN_S),
        "Simulated time at which a run ends",
        HAS_TO_BE_GIVEN,
    ),
    _option("seed-set", integer(0, LARGEST_SEED), "Seed of all random numbers of a run", "${runnumber}"),
    _option(
        "repeat",
        integer(1, 1_000_000),
        "Number of runs of each combination of values of `${...}`, each with its own seed",
        "1",
    ),
    _option(
        "constraint",
        text(),
        "Condition on the values of a run: `$x < $y && $x != 3`; by default all combinations are runs",
        '""',
    ),
    _option(
        "iteration-nesting-order",
        text(),
        "Names of iteration variables, the outermost first: `repetition, *, x`; `*`: the others in order",
        "*, repetition",
    ),
    _option(
        "experiment-label",
        text(),
        "What `--scalars` and `--vectors` call the runs of a configuration",
        "${configname}",
    ),
    _option(
        "measurement-label",
        text(),
        "What they call the runs with equal values of `${...}`",
        "${iterationvars}",
    ),
    _option("replication-label", text(), "What they call one of these runs", "#${repetition}"),
    _option(
        "vector-record-interval",
        quantity("s", at_least=0, at_most=LONGEST_RUN_S),
        "Least time between two rows that `--vectors` writes of a variable or position",
        "0s",
    ),
    _option("description", text(), "Description of the configuration", '""'),
)

OPTIONS: dict[str, ParameterType] = {key.path: key.kind for key in OPTION_KEYS}

NETWORK = "network"
"""Option for the first name of paths. Nothing else of OMNeT++'s option is used."""

SECTION_OPTIONS = ("extends", "abstract")
"""Options that belong to a section and cannot be given on the command line."""

IGNORED_OPTIONS = (
    "allow-object-stealing-on-deletion", "check-signals", "config-recording", "configuration-class",
    "debug-on-errors", "debug-statistics-recording", "eventlogmanager-class", "fname-append-host",
    "futureeventset-class", "image-path", "load-libs", "max-module-nesting", "num-rngs",
    "outputscalarmanager-class", "outputvectormanager-class", "parallel-simulation",
    "parameter-mutability-check", "record-eventlog", "result-dir", "resultdir-subdivision", "rng-class",
    "runnumber-width", "sectionbasedconfig-configreader-class", "simtime-resolution", "simtime-scale",
    "snapshot-file", "snapshotmanager-class", "total-stack", "user-interface", "warnings",
)  # fmt: skip
"""Options of a run that only OMNeT++ reads."""

IGNORED_OPTION_BEGINNINGS = (
    "cmdenv-", "debugger-attach-", "eventlog-", "fingerprint", "ned-", "output-scalar-", "output-vector",
    "parsim-", "print-", "qtenv-",
)  # fmt: skip
"""Of the names of such options."""

IGNORED_BEGINNINGS = (
    "cmdenv-", "qtenv-", "rng-", "vector-recording", "vector-record-e", "vector-buffer",
)  # fmt: skip
"""Of the last names of keys: options that are given per module, such as `**.cmdenv-log-level`."""

IGNORED_ENDS = (
    *(f"{kind}-recording" for kind in ("scalar", "statistic", "bin", "param", "module-eventlog")),
    "result-recording-modes",
    "param-record-as-scalar",
    "display-name",
    "display-string",
    "partition-id",
)
"""Last names of keys: what OMNeT++ records of a module, shows of it, and where it runs it."""

IGNORED_MODULES = ("visualizer",)
"""Names below the network whose parameters are OMNeT++'s alone."""

REFUSED_OPTIONS = MappingProxyType(
    {
        "warmup-period": "results are of whole runs; expected a protocol that begins to count later",
        "cpu-time-limit": "a run ends in simulated time; expected `sim-time-limit`",
        "real-time-limit": "a run ends in simulated time; expected `sim-time-limit`",
        "scheduler-class": "expected `real_time` in a script, for runs that go by the clock",
        "realtimescheduler-scaling": "expected `real_time` in a script, for runs that go by the clock",
        "seed-*": "a run has one seed for all its streams; expected `seed-set`",
    }
)
"""{option, with `*` for any letters: what to do without it}."""
