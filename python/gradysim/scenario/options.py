"""Options of a run, and options that only OMNeT++ has, in files that are shared with it.

Of the latter, those that say how OMNeT++ runs, shows and records are ignored. Those that would make another
run are refused.
"""

from types import MappingProxyType

from gradysim.scenario.parameter_types import ParameterType, integer, quantity, text
from gradysim.scenario.schema import HAS_TO_BE_GIVEN, Key

LONGEST_RUN_S = 9_200_000
"""The engine's bound, SimTime::longest_run_s: its clock counts picoseconds in 64 bits. Both modes have it."""

LARGEST_SEED = 2**63 - 1
"""Of a run, in both modes."""

OPTION_KEYS: tuple[Key, ...] = (
    Key(
        "sim-time-limit",
        "option.sim_time_limit",
        quantity("s", above=0, at_most=LONGEST_RUN_S),
        "Simulated time at which a run ends",
        default=HAS_TO_BE_GIVEN,
    ),
    Key(
        "seed-set",
        "option.seed_set",
        integer(0, LARGEST_SEED),
        "Seed of all random numbers of a run",
        default="${runnumber}",
    ),
    Key(
        "repeat",
        "option.repeat",
        integer(1, 1_000_000),
        "How many runs there are of each combination of values of `${...}`, with a seed each",
        default="1",
    ),
    Key(
        "constraint",
        "option.constraint",
        text(),
        "Which combinations of values are runs: `$x < $y && $x != 3`; all by default",
        default='""',
    ),
    Key(
        "iteration-nesting-order",
        "option.iteration_nesting_order",
        text(),
        "Names of iteration variables, the outermost first: `repetition, *, x`; `*`: the others in order",
        default="*, repetition",
    ),
    Key(
        "experiment-label",
        "option.experiment_label",
        text(),
        "What `--scalars` and `--vectors` call the runs of a configuration",
        default="${configname}",
    ),
    Key(
        "measurement-label",
        "option.measurement_label",
        text(),
        "What they call the runs with equal values of `${...}`",
        default="${iterationvars}",
    ),
    Key(
        "replication-label",
        "option.replication_label",
        text(),
        "What they call one of these runs",
        default="#${repetition}",
    ),
    Key("description", "option.description", text(), "What the configuration is about", default='""'),
)

OPTIONS: dict[str, ParameterType] = {key.path: key.kind for key in OPTION_KEYS}

NETWORK = "network"
"""The option that says what paths begin with: OMNeT++'s, of which nothing else counts."""

SECTION_OPTIONS = ("extends", "abstract")
"""Options that belong to a section and cannot be given on the command line."""

IGNORED_OPTIONS = (
    "allow-object-stealing-on-deletion",
    "check-signals",
    "config-recording",
    "configuration-class",
    "debug-on-errors",
    "debug-statistics-recording",
    "eventlogmanager-class",
    "fname-append-host",
    "futureeventset-class",
    "image-path",
    "load-libs",
    "max-module-nesting",
    "num-rngs",
    "outputscalarmanager-class",
    "outputvectormanager-class",
    "parallel-simulation",
    "parameter-mutability-check",
    "record-eventlog",
    "result-dir",
    "resultdir-subdivision",
    "rng-class",
    "runnumber-width",
    "sectionbasedconfig-configreader-class",
    "simtime-resolution",
    "simtime-scale",
    "snapshot-file",
    "snapshotmanager-class",
    "total-stack",
    "user-interface",
    "warnings",
)
"""Options of a run that only OMNeT++ reads."""

IGNORED_OPTION_BEGINNINGS = (
    "cmdenv-",
    "debugger-attach-",
    "eventlog-",
    "fingerprint",
    "ned-",
    "output-scalar-",
    "output-vector",
    "parsim-",
    "print-",
    "qtenv-",
)
"""Of the names of such options."""

IGNORED_BEGINNINGS = ("cmdenv-", "qtenv-", "rng-", "vector-record", "vector-buffer")
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
