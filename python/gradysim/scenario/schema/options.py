"""The options of a run, and the lines that only OMNeT++ reads.

Of OMNeT++'s own options, those that say how it runs, shows and records are ignored. Those that would make
another run are refused.
"""

import re
from collections.abc import Iterable
from fnmatch import fnmatchcase
from types import MappingProxyType

from gradysim.scenario.errors import ConfigError, nearest
from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.schema.engine_keys import HAS_TO_BE_GIVEN, Key
from gradysim.scenario.schema.parameter_types import ParameterType, integer, quantity, text

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

_NETWORK_NAME = re.compile(r'("?)(?:[A-Za-z_]\w*\.)*([A-Za-z_]\w*)\1', re.ASCII)
"""Names of packages may precede it; quotes are optional."""


def network_name(entries: Iterable[Entry]) -> str:
    """Return what paths begin with: the option `network`, in which packages may precede the name.

    Raises ConfigError if it has variables or is not a name.
    """
    network = next((entry for entry in entries if entry.key == NETWORK), None)
    if network is None:
        return "Network"
    if "${" in network.text:
        text = "it is the same in all runs"
        raise ConfigError.at(network.source, text, expected="a name without variables")
    match = _NETWORK_NAME.fullmatch(network.text)
    if match is None:
        expected = "the name of a network, such as `Network` or `package.Network`"
        raise ConfigError.at(network.source, f"`{network.text}` is not a name", expected=expected)
    return match[2]


def is_option(entry: Entry) -> bool:
    """Return whether the key is that of an option: it has no dot."""
    return "." not in entry.key


def options_in_force(entries: Iterable[Entry]) -> dict[str, Entry]:
    """Return the entry in force for each option that is set."""
    options: dict[str, Entry] = {}
    for entry in entries:
        if entry.key in OPTIONS:
            options.setdefault(entry.key, entry)
    return {key: entry for key, entry in options.items() if entry.text != "default"}


def is_ignored(entry: Entry) -> bool:
    """Return whether only OMNeT++ reads an entry. Its value is not checked."""
    parts = entry.key.split(".")
    if len(parts) == 1:
        return entry.key in IGNORED_OPTIONS or entry.key.startswith(IGNORED_OPTION_BEGINNINGS)
    if parts[-1].startswith(IGNORED_BEGINNINGS) or parts[-1] in IGNORED_ENDS:
        return True
    return len(parts) > 2 and parts[1] in IGNORED_MODULES


def check_option(entry: Entry) -> None:
    """Raise ConfigError if the option does not exist or cannot be set there."""
    key = entry.key
    if key in SECTION_OPTIONS and entry.source.is_override:
        raise ConfigError(f"`{key}` belongs to a section", entry.source, expected="it in the file")
    if key in (*OPTIONS, *SECTION_OPTIONS, NETWORK) or is_ignored(entry):
        return
    for option, instead in REFUSED_OPTIONS.items():
        if fnmatchcase(key, option):
            raise ConfigError(f"`{key}` is an option that only OMNeT++ has: {instead}", entry.source)
    match = nearest(key, [*OPTIONS, *SECTION_OPTIONS, NETWORK, "result-dir"])
    if re.fullmatch(r"num[A-Z]\w*", key):
        match = f"*.{key}"
    raise ConfigError(
        f"there is no option `{key}`",
        entry.source,
        expected="an option, or a parameter such as `*.uavs[*].mobility.speed`",
        suggestion=match,
    )
