"""The options of the commands, each declared once: its name, type, default and help."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

if TYPE_CHECKING:
    from cyclopts import Token

    from gradysim.scenario.schema.parameter_types import ParameterType, Scalar

Mode = Literal["integrated", "prototype"]
"""Same as in `gradysim.results.result`, which `gradysim --help` does not load."""

LogLevel = Literal["debug", "info", "warning", "error"]

DEFAULT_DIR = Path("results")

FileArgument = Annotated[Path, Parameter(name="FILE", help="The .ini file.")]
ResultsArgument = Annotated[
    Path, Parameter(name="DIR", help="The directory of `run --result-dir`, or a file of `gradysim pack`.")
]
ResultDir = Annotated[Path, Parameter(help="The directory of `run --result-dir`.")]
RunsOption = Annotated[
    str | None,
    Parameter(alias="-r", help="Run numbers such as 0..3,5; all runs of the configuration by default."),
]
ConfigOption = Annotated[str, Parameter(alias="-c", help="Name of the configuration: a section of the file.")]
SetOption = Annotated[
    tuple[str, ...],
    Parameter(
        name="--set",
        negative="",
        show_default=False,
        help="KEY=VALUE: takes precedence over the file; may be repeated, for other keys.",
    ),
]
"""Shared by several commands."""


def _integer(_type: type, tokens: "Sequence[Token]") -> int:
    """Convert as int() does. Cyclopts would round `1.5` to 2, and another seed is another run."""
    text = tokens[0].value
    try:
        return int(text)
    except ValueError:
        raise ValueError(f"{text} is not an integer") from None


Integer = Annotated[int, Parameter(converter=_integer, n_tokens=1)]
Flag = Annotated[bool, Parameter(negative="", show_default=False)]


Names = Annotated[tuple[str, ...], Parameter(negative="", consume_multiple=(1, None), show_default=False)]


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class PlotOptions:
    """Options of `gradysim plot`. The docstring of a field is its help."""

    output: Annotated[Path, Parameter(alias="-o")]
    """The file of the figure: .pdf, .png or .svg. Its numbers and their origin go to files of the same name
    that end in .csv and .json."""

    kind: Literal["line", "diff", "cdf", "time", "outcomes", "map"] = "line"
    """line: means over x. diff: differences between runs of the same seed. cdf: a distribution. time: a
    tracked variable over time. outcomes: what became of frames or messages. map: where nodes were. time and
    map read the files of `run --vectors`."""

    x: str | None = None
    """Variable of the x axis: one of `${name=...}` in the .ini file, config or mode."""

    metric: Annotated[str | None, Parameter(name=("--metric", "--y"))] = None
    """Quantity, by the name that `gradysim means` prints, cpu_s or events. For outcomes: a kind of frames or
    messages, such as `broadcast frames`."""

    by: Names = ()
    """VARIABLE...: a curve for each value; by default for all variables that differ except x. --kind diff
    compares the values of the first one."""

    where: Names = ()
    """VARIABLE=VALUE...: only these runs, such as config=Study jitter=1ms jitter=10ms."""

    baseline: str | None = None
    """Value that the others are compared with, for --kind diff; by default the first one."""

    omit: Names = ()
    """OUTCOME...: outcomes to leave out, such as `below sensitivity`, for --kind outcomes."""

    log: Annotated[
        tuple[Literal["x", "y"], ...],
        Parameter(negative="", consume_multiple=(1, None), show_default=False),
    ] = ()
    """x, y: axes with a logarithmic scale."""

    columns: Literal[1, 2] = 1
    """Width of the figure, in columns of a page: 3.5 or 7.16 inches."""


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class CompareOptions:
    """Options of `gradysim compare`. The docstring of a field is its help."""

    by: str | None = None
    """Variable whose two values in one directory are compared: mode, config or one of `${name=...}` in the
    .ini file."""

    baseline: str | None = None
    """Value of --by that the other one is compared with; by default the first one."""

    where: Names = ()
    """VARIABLE=VALUE...: only these runs, as in `gradysim plot`."""

    metric: Names = ()
    """QUANTITY...: quantities to compare, by name, as in `gradysim means`. Default: those that it prints."""

    as_csv: Annotated[Flag, Parameter(name="--csv")] = False
    """Print CSV, with all digits, for other programs."""

    output: Annotated[Path | None, Parameter(alias="-o")] = None
    """Draw the differences, in percent, to this file: .pdf, .png or .svg. Their numbers and their origin go
    to files of the same name that end in .csv and .json."""


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class RunOptions:
    """Options of `gradysim run`. The docstring of a field is its help."""

    config: ConfigOption = "General"

    runs: RunsOption = None

    share: str | None = None
    """I/N: of these runs only every Nth, from position I = 0 to N-1 on. auto: as the variables of SLURM,
    Grid Engine or MPI say. auto/N: for PBS and Kubernetes, which do not say N."""

    mode: Mode = "integrated"
    """The 802.11 network of the compiled engine, or the plain simulator in Python. Broadcasts of a file
    that sets neither a range nor a power reach 786 m and 60 m: `gradysim keys range`."""

    settings: SetOption = ()

    seed: Integer | None = None
    """Seed of run 0, to which run N adds N; by default the file's seed-set."""

    result_dir: Path | None = None
    """Write the JSON object of each run to DIR/CONFIG-#RUN.MODE.json."""

    resume: Flag = False
    """Skip runs whose file in --result-dir is complete and has the same settings, seed and files (protocols,
    obstacles), with the output of --scalars, --vectors, --pcap, --replay and --outcomes-at. Results of other
    settings or seeds are an error, as without this option."""

    replace: Flag = False
    """Replace results of other settings or seeds in --result-dir. Without this option they are an error. Each
    is kept until the new one is complete."""

    until: str | None = None
    """Condition such as 'ci(QUANTITY) < 5%': run repetitions until half the width of the quantity's 95 %
    confidence interval is below 5 % of its mean, for each combination of values. `repeat` is the most."""

    jobs: Annotated[Integer, Parameter(alias="-j")] = 1
    """Number of runs at the same time, by processes of this machine or workers of --executor dask on it."""

    executor: Literal["processes", "dask"] = "processes"
    """What computes the runs: processes of this machine, or the workers of a Dask cluster."""

    scheduler: str | None = None
    """Address of the Dask scheduler, such as tcp://10.0.0.1:8786; without it, --jobs workers start here."""

    stop_after: str | None = None
    """Wall time such as 55min, after which the command stops as after Ctrl-C. The exit code is 5 then."""

    memory: str | None = None
    """Memory that each run may allocate, such as 2GB. A run that needs more ends, and the others continue."""

    scalars: Flag = False
    """Write the numbers of each run to DIR/CONFIG-#RUN.MODE.sca for OMNeT++'s analysis tools. DIR is
    --result-dir (default: results)."""

    vectors: Names = ()
    """NODE...: write tracked variables and positions of these nodes over time to DIR/CONFIG-#RUN.MODE.vec. A
    node (uavs[0]), a group (uavs), or all."""

    pcap: Names = ()
    """NODE...: write sent and received frames of these nodes to DIR/CONFIG-#RUN-NODE.pcap (for wlan[1]:
    …-wlan1.pcap). A node (uavs[0]), a group (uavs), or all."""

    replay: Names = ()
    """NODE...: write a page with all events at these nodes to DIR/CONFIG-#RUN.MODE.html, for any browser. A
    node (uavs[0]), a group (uavs), or all."""

    trace: Names = ()
    """NODE...: print a line for each event at these nodes: frames, receptions and their outcomes, timers,
    commands, tracked variables. A node (uavs[0]), a group (uavs), or all."""

    log_level: LogLevel | None = None
    """Print what protocols log from this level on; default: info, with --quiet warning. With debug, also
    print what gradysim logs."""

    outcomes_at: Annotated[Names, Parameter(alias="--fates-at")] = ()
    """NODE...: report the outcomes of frames at these nodes, the interferers, and the outcomes of messages
    that these nodes sent. A node (uavs[0]), a group (uavs), or all."""

    as_json: Annotated[Flag, Parameter(name="--json")] = False
    """Print only one JSON object per run, each on one line."""

    details: Flag = False
    """Print all numbers of each run, with tables of nodes, outcomes and delays."""

    quiet: Flag = False
    """Print warnings and failures only, without progress bar and summaries."""

    @property
    def directory(self) -> Path:
        """Directory of all files."""
        return DEFAULT_DIR if self.result_dir is None else self.result_dir

    @property
    def is_writer(self) -> bool:
        """Whether runs write a file to the directory."""
        return self.writes_files or bool(self.pcap)

    @property
    def writes_files(self) -> bool:
        """Whether the directory must exist before the runs. Captures create it themselves."""
        return self.result_dir is not None or self.scalars or bool(self.vectors) or bool(self.replay)


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class StatusOptions:
    """Options of `gradysim status`, those of the command that computes the runs."""

    config: ConfigOption = "General"

    runs: RunsOption = None

    mode: Mode = "integrated"
    """As in `gradysim run`."""

    settings: SetOption = ()

    seed: Integer | None = None
    """As in `gradysim run`."""

    missing: Flag = False
    """Print only the numbers of the runs that are not done, as `gradysim run -r` takes them."""


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class ViewOptions:
    """Options of `gradysim view`."""

    config: ConfigOption = "General"

    run: Annotated[Integer, Parameter(name=("--run", "-r", "--runs"))] = 0
    """Number of the run."""

    mode: Mode = "integrated"
    """As in `gradysim run`."""

    settings: SetOption = ()

    seed: Integer | None = None
    """As in `gradysim run`."""

    host: str = "127.0.0.1"
    """Address of the server: 0.0.0.0 for all addresses of the machine, such as in a container."""

    port: Integer = 0
    """Port of the server; 0 for any free port."""

    browser: Annotated[bool, Parameter(negative="--no-browser", show_default=False)] = True
    """Open the page. Otherwise only its address is printed."""


FigureOption = Annotated[
    Path | None,
    Parameter(
        name=("--output", "-o", "--plot"),
        help="Draw it to this file: .pdf, .png or .svg. Its numbers and their origin go to files of the same"
        " name that end in .csv and .json.",
    ),
]
RunCountOption = Annotated[
    Integer,
    Parameter(
        name=("--repeat", "-n"),
        help="Number of runs with the same effects, each with its own seed; it replaces the file's `repeat`.",
    ),
]
"""Shared by the commands about levels of realism."""


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class CampaignOptions:
    """Options of the commands about levels of realism."""

    config: ConfigOption = "General"

    settings: SetOption = ()

    seed: Integer | None = None
    """As in `gradysim run`."""

    jobs: Annotated[Integer, Parameter(alias="-j")] = os.cpu_count() or 1
    """Number of runs at the same time; by default one for each core."""

    result_dir: Path | None = None
    """Keep what each run shows in DIR/CONFIG.runs.jsonl."""

    resume: Flag = False
    """Use the runs that are kept in --result-dir if they have the same settings, seed and files. They may be
    those of another command about levels."""

    as_json: Annotated[Flag, Parameter(name="--json")] = False
    """Print only a JSON object, on one line."""


def option_value(option: str, text: str, kind: "ParameterType") -> "Scalar":
    """Return the value of an option. Raises ConfigError, which names the option."""
    from gradysim.scenario.errors import BadValue, ConfigError
    from gradysim.scenario.parse.expressions import parse_value

    try:
        return kind.convert(parse_value(text))
    except BadValue as error:
        raise ConfigError(
            f"{option} {text}: {error.problem}",
            expected=kind.expected,
            suggestion=error.suggestion,
            hint=error.hint,
        ) from error
