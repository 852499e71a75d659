"""The options of the commands, each declared once: its name, type, default and help."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

if TYPE_CHECKING:
    from cyclopts import Token

    from gradysim.scenario.parameter_types import ParameterType, Scalar

Mode = Literal["integrated", "prototype"]
"""The same as in `gradysim.results.result`, which `gradysim --help` does not load."""

LogLevel = Literal["debug", "info", "warning", "error"]

DEFAULT_DIR = Path("results")

FileArgument = Annotated[Path, Parameter(name="FILE", help="The .ini file.")]
ResultsArgument = Annotated[Path, Parameter(name="DIR", help="The directory of `run --result-dir`.")]
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
"""Of several commands."""


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

    y: str | None = None
    """Quantity, by the name that `gradysim means` prints, cpu_s or events. Of outcomes: a kind of frames or
    messages, such as `broadcast frames`."""

    by: Names = ()
    """VARIABLE...: a curve for each value; by default of all variables that differ besides x. --kind diff
    compares the values of the first one."""

    where: Names = ()
    """VARIABLE=VALUE...: only these runs, such as config=Study jitter=1ms jitter=10ms."""

    baseline: str | None = None
    """Of --kind diff: the value that the others are compared with; by default the first one."""

    omit: Names = ()
    """OUTCOME...: of --kind outcomes, outcomes to leave out, such as `below sensitivity`."""

    log: Annotated[
        tuple[Literal["x", "y"], ...],
        Parameter(negative="", consume_multiple=(1, None), show_default=False),
    ] = ()
    """x, y: axes with a logarithmic scale."""

    columns: Literal[1, 2] = 1
    """Width of the figure, in columns of a page: 3.5 or 7.16 inches."""


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class RunOptions:
    """Options of `gradysim run`. The docstring of a field is its help."""

    config: ConfigOption = "General"

    runs: Annotated[str | None, Parameter(alias="-r")] = None
    """Run numbers such as 0..3,5; all runs of the configuration by default."""

    mode: Mode = "integrated"
    """The 802.11 network of the compiled engine, or the plain simulator in Python. Their messages reach 786 m
    and 60 m by default: `gradysim keys range`."""

    settings: SetOption = ()

    seed: Integer | None = None
    """Seed of run 0, to which run N adds N; by default the file's seed-set."""

    result_dir: Path | None = None
    """Write each run's JSON object to DIR/CONFIG-#RUN.MODE.json."""

    resume: Flag = False
    """Leave out runs whose file in --result-dir is complete and of the same settings, seed and files
    (protocols, obstacles), with what --scalars, --vectors, --pcap, --replay and --fates-at ask for."""

    replace: Flag = False
    """Replace results of other settings or seeds in --result-dir. Without it they are an error."""

    jobs: Annotated[Integer, Parameter(alias="-j")] = 1
    """How many runs at once."""

    memory: str | None = None
    """Memory that each run may allocate, such as 2GB. A run that needs more ends, and the others go on."""

    scalars: Flag = False
    """Write the numbers of each run to DIR/CONFIG-#RUN.MODE.sca for OMNeT++'s analysis tools, DIR as in
    --result-dir (default: results)."""

    vectors: Names = ()
    """NODE...: write what tracked variables and positions of these nodes were over time to
    DIR/CONFIG-#RUN.MODE.vec, DIR as above. A node (uavs[0]), a group (uavs), or all."""

    pcap: Names = ()
    """NODE...: write what the radios of these nodes send and receive to DIR/CONFIG-#RUN-NODE.pcap (that of
    its wlan[1]: …-wlan1.pcap), DIR as in --result-dir (default: results). A node (uavs[0]), a group (uavs),
    or all."""

    replay: Names = ()
    """NODE...: write what happens at these nodes to DIR/CONFIG-#RUN.MODE.html, DIR as above,
    a page that any browser shows. A node (uavs[0]), a group (uavs), or all."""

    trace: Names = ()
    """NODE...: print a line for each event at these nodes: frames, receptions and their outcomes, timers,
    commands, tracked variables. A node (uavs[0]), a group (uavs), or all."""

    log_level: LogLevel | None = None
    """Print what protocols log from this level on, by default info, with --quiet warning. With debug, also
    what gradysim logs."""

    fates_at: Names = ()
    """NODE...: report what became of the frames that reached these nodes, who interfered, and what became of
    the messages that they sent. A node (uavs[0]), a group (uavs), or all."""

    as_json: Annotated[Flag, Parameter(name="--json")] = False
    """Print one JSON object per run, one per line, no more."""

    details: Flag = False
    """Print all numbers of each run, with tables of nodes, outcomes and delays."""

    quiet: Flag = False
    """No progress bar and no summaries: warnings and failures only."""

    @property
    def directory(self) -> Path:
        """The directory of all files."""
        return DEFAULT_DIR if self.result_dir is None else self.result_dir

    @property
    def is_writer(self) -> bool:
        """Whether runs write any file to the directory."""
        return self.writes_files or bool(self.pcap)

    @property
    def writes_files(self) -> bool:
        """Whether the directory has to exist before the runs; captures make it themselves."""
        return self.result_dir is not None or self.scalars or bool(self.vectors) or bool(self.replay)


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class ViewOptions:
    """Options of `gradysim view`."""

    config: ConfigOption = "General"

    run: Annotated[Integer, Parameter(alias="-r")] = 0
    """Number of the run."""

    mode: Mode = "integrated"
    """As of `gradysim run`."""

    settings: SetOption = ()

    seed: Integer | None = None
    """As of `gradysim run`."""

    host: str = "127.0.0.1"
    """Address that the server listens on: 0.0.0.0 for all, such as in a container."""

    port: Integer = 0
    """Port of the server; 0 for a free one."""

    browser: Annotated[bool, Parameter(negative="--no-browser", show_default=False)] = True
    """Open the page. Otherwise only its address is printed."""


def option_value(option: str, text: str, kind: "ParameterType") -> "Scalar":
    """Return the value that an option says. Raises ConfigError, which names the option."""
    from gradysim.scenario.errors import BadValue, ConfigError
    from gradysim.scenario.expressions import parse_value

    try:
        return kind.convert(parse_value(text))
    except BadValue as error:
        raise ConfigError(
            f"{option} {text}: {error.problem}",
            expected=kind.expected,
            suggestion=error.suggestion,
            hint=error.hint,
        ) from error
