"""Options of a run."""

from gradysim.scenario.keys.key import HAS_TO_BE_GIVEN, Key
from gradysim.scenario.parameter_types import ParameterType, integer, quantity, text

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
