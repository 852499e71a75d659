"""The command `gradysim`.

    gradysim run FILE.ini [-c CONFIG] [-r RUNS] [--mode integrated|prototype] ...
    gradysim runs FILE.ini [-c CONFIG]
    gradysim keys [PATTERN] [--markdown]
    gradysim calibrate FILE.ini [-c CONFIG] --range 50m ...

Exit codes: 0 all is well; 1 a protocol failed; 2 a mistake in the arguments or in the .ini file;
130 Ctrl-C. What only one command needs is imported inside it, so that `gradysim --help` answers at once.
"""

import contextlib
import json
import os
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from io import TextIOWrapper
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, TextIO

from cyclopts import App, CycloptsError, Parameter

if TYPE_CHECKING:
    from gradysim.config.kinds import Kind, Scalar
    from gradysim.config.scenario import Scenario
    from gradysim.report.supervised_run import Outcome, Run
    from gradysim.results.run_result import RunResult

OK, FAILED, MISTAKE, INTERRUPTED = 0, 1, 2, 130

Mode = Literal["integrated", "prototype"]

FileArgument = Annotated[Path, Parameter(name="FILE", help="The .ini file.")]
ConfigOption = Annotated[str, Parameter(alias="-c", help="Name of the configuration: a section of the file.")]
SetOption = Annotated[
    tuple[str, ...],
    Parameter(
        name="--set",
        negative="",
        show_default=False,
        help="KEY=VALUE: takes precedence over the file; may be repeated.",
    ),
]
PcapOption = Annotated[
    tuple[str, ...],
    Parameter(
        negative="",
        consume_multiple=(1, None),
        show_default=False,
        help="NODE...: write what the radios of these nodes send and receive to DIR/CONFIG-#RUN-NODE.pcap"
        " (that of its wlan[1]: …-wlan1.pcap), DIR as in --result-dir (default: results). A node (uavs[0]), a"
        " group (uavs), or all.",
    ),
]


def installed_version() -> str:
    """Return the version of the installed package."""
    from importlib import metadata

    try:
        return metadata.version("gradysim")
    except metadata.PackageNotFoundError:
        return "unknown (gradysim is not installed)"


app = App(
    name="gradysim",
    help="Simulator of flying networks: one Python protocol, from a prototype to a realistic 802.11 network.",
    version=installed_version,
    suppress_keyboard_interrupt=False,
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Carry out a command line (that of this process by default) and return the exit code."""
    if isinstance(sys.stdout, TextIOWrapper) and sys.stdout.errors == "strict":
        sys.stdout.reconfigure(errors="backslashreplace")  # rather than lose a result over a letter in it
    try:
        code = app(arguments, exit_on_error=False, print_error=True, result_action="return_value")
        sys.stdout.flush()  # here, where it is known what to do if nobody reads it
    except CycloptsError:  # cyclopts has said what is wrong
        return MISTAKE
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:  # who reads the output, such as `head`, has had enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # the interpreter flushes once more
        return OK
    return code if isinstance(code, int) else OK


@app.command
def run(
    file: FileArgument,
    /,
    *,
    config: ConfigOption = "General",
    runs: Annotated[
        str | None,
        Parameter(alias="-r", help="Run numbers such as 0..3,5; all runs of the configuration by default."),
    ] = None,
    mode: Annotated[
        Mode, Parameter(help="The 802.11 network of the compiled engine, or the plain simulator in Python.")
    ] = "integrated",
    settings: SetOption = (),
    seed: Annotated[
        int | None, Parameter(help="Seed of run 0, to which run N adds N; by default the file's seed-set.")
    ] = None,
    result_dir: Annotated[
        Path | None, Parameter(help="Write each run's JSON object to DIR/CONFIG-#RUN.MODE.json.")
    ] = None,
    pcap: PcapOption = (),
    as_json: Annotated[
        bool,
        Parameter(name="--json", negative="", help="Print one JSON object per run, one per line, no more."),
    ] = False,
    quiet: Annotated[bool, Parameter(negative="", help="No progress bar.")] = False,
) -> int:
    """Run the runs of a configuration and say what came out."""
    from gradysim.config.error import ConfigError
    from gradysim.integrated.compiled_part import CompiledPartMissingError
    from gradysim.report.interrupt import StopOnInterrupt

    output = sys.stdout
    # What protocols print, also when they are imported, must not get between the JSON objects.
    with contextlib.redirect_stdout(sys.stderr) if as_json else contextlib.nullcontext():
        try:
            if result_dir is not None:
                make_result_dir(result_dir)
            scenarios = load(file, config, runs, settings, seed)
            check, build = simulator(mode) if not pcap else capturing_simulator(mode, pcap, result_dir)
            warn_of_equal_seeds(scenarios)
            warn_of_shadowed_lines(file, config)
            for scenario in scenarios:
                check(scenario)
            if mode == "integrated":
                warn_of_what_is_seldom_meant(scenarios)
            with StopOnInterrupt() as interrupt:
                for done, scenario in enumerate(scenarios):
                    if interrupt.should_stop():  # pressed between two runs
                        say_unfinished(scenarios, done)
                        return INTERRUPTED
                    bar = not quiet and not as_json
                    outcome = run_one(build, scenario, interrupt.should_stop, bar=bar)
                    code = report(outcome, output, result_dir, as_json=as_json)
                    if pcap and outcome.result is not None:
                        for capture in files_written(scenario, captures(scenario, pcap, result_dir)):
                            print(f"captured in {capture}")
                    if code != OK:
                        say_unfinished(scenarios, done, "failed" if code == FAILED else "was interrupted")
                        return code
        except (ConfigError, CompiledPartMissingError, OSError) as mistake:
            return say_mistake(mistake)
    return OK


@app.command(name="runs")
def list_runs(file: FileArgument, /, *, config: ConfigOption = "General", settings: SetOption = ()) -> int:
    """List the runs of a configuration."""
    from gradysim.config.error import ConfigError

    try:
        for scenario in load(file, config, None, settings):
            print(f"Run {scenario.run_number}: $repetition={scenario.run_number}")
    except ConfigError as mistake:
        return say_mistake(mistake)
    return OK


@app.command(name="keys")
def list_keys(
    pattern: Annotated[str, Parameter(name="PATTERN", help="Part of a key, or a pattern with *.")] = "",
    /,
    *,
    markdown: Annotated[bool, Parameter(negative="", help="A page in Markdown.")] = False,
) -> int:
    """List the keys of .ini files: unit, default, meaning."""
    from gradysim.config.key_list import key_sections, matching
    from gradysim.integrated.compiled_part import CompiledPartMissingError
    from gradysim.integrated.engine_defaults import engine_defaults
    from gradysim.integrated.native_protocols import native_protocols
    from gradysim.report import key_table

    try:
        structs, natives = engine_defaults(), list(native_protocols().values())
    except CompiledPartMissingError:
        structs, natives = {}, []
        print("defaults shown as ? are the compiled part's, which is not installed", file=sys.stderr)
    sections = matching(key_sections(structs, natives), pattern)
    if not sections:
        print(f"no key contains {pattern!r}; `gradysim keys` lists all", file=sys.stderr)
        return MISTAKE
    if markdown:
        print(key_table.markdown(sections), end="")
    elif sys.stdout.isatty():
        from rich.console import Console

        Console().print(key_table.rich_tables(sections))
    else:
        print(key_table.plain_text(sections), end="")
    return OK


@app.command(name="calibrate")
def calibrate_power(
    file: FileArgument,
    /,
    *,
    config: ConfigOption = "General",
    range_text: Annotated[
        str, Parameter(name="--range", allow_leading_hyphen=True, help="The wanted range, such as 50m.")
    ],
    ratio: Annotated[float, Parameter(help="Share of the frames that is to be received there.")] = 0.5,
    message: Annotated[
        str, Parameter(allow_leading_hyphen=True, help="Length of the message in a frame.")
    ] = "50B",
    sender: Annotated[str | None, Parameter(help="Node that sends; by default the first one.")] = None,
    receiver: Annotated[
        str | None, Parameter(help="Node that receives; by default another one like the sender.")
    ] = None,
    picture: Annotated[
        Path | None, Parameter(help="Draw reception over distance into this file (.png, .svg, .pdf).")
    ] = None,
    settings: SetOption = (),
) -> int:
    """Find the transmitter power for a wanted range under the models of a configuration."""
    from gradysim.config.error import ConfigError
    from gradysim.config.kinds import quantity, whole_bytes
    from gradysim.integrated.calibration import calibrate
    from gradysim.integrated.compiled_part import CompiledPartMissingError
    from gradysim.report import calibration

    try:
        scenario = load(file, config, "0", settings)[0]
        if picture is not None:
            calibration.check_picture(picture)
        found = calibrate(
            scenario,
            range_m=float(option_value("--range", range_text, quantity("m", at_least=0))),
            ratio=ratio,
            message_bytes=int(option_value("--message", message, whole_bytes())),
            sender=sender,
            receiver=receiver,
        )
        print(calibration.text(found, sys.stdout.encoding))
        if picture is not None:
            calibration.draw(found, picture)
            print(f"drawn in {picture}")
    except (ConfigError, CompiledPartMissingError, ImportError, ValueError, OSError) as mistake:
        return say_mistake(mistake)
    return OK


def option_value(option: str, text: str, kind: "Kind") -> "Scalar":
    """Return the value that an option says. Raises ConfigError, which names the option."""
    from gradysim.config.error import BadValue, ConfigError
    from gradysim.config.expression import parse_value

    try:
        return kind.convert(parse_value(text))
    except BadValue as error:
        raise ConfigError(
            f"{option} {text}: {error.problem}; expected {kind.expected}{error.suggestion}"
        ) from error


def warn_of_equal_seeds(scenarios: "Sequence[Scenario]") -> None:
    """Say on the error output that runs share a seed."""
    seeds = {scenario.seed for scenario in scenarios}
    if len(seeds) < len(scenarios):
        same = f"seed {seeds.pop()}" if len(seeds) == 1 else "only a few different seeds"
        print(
            f"warning: the {len(scenarios)} runs of {scenarios[0].config} have {same}: runs with one seed are"
            " identical if nothing else depends on ${runnumber}; `seed-set = ${runnumber}` is the default",
            file=sys.stderr,
        )


def warn_of_shadowed_lines(file: Path, config: str) -> None:
    """Say on the error output which lines of the file have no effect, because of others above them."""
    from gradysim.config.shadowed_lines import shadowed_lines

    for text in shadowed_lines(file, config):
        print(text, file=sys.stderr)


def warn_of_what_is_seldom_meant(scenarios: "Sequence[Scenario]") -> None:
    """Say on the error output, once for all runs, which lines nothing reads, and the like."""
    from gradysim.integrated.scenario_warnings import scenario_warnings

    different = {(id(scenario.nodes), id(scenario.medium)): scenario for scenario in scenarios}
    for text in dict.fromkeys(
        text for scenario in different.values() for text in scenario_warnings(scenario)
    ):
        print(text, file=sys.stderr)


def make_result_dir(directory: Path) -> None:
    """Make the folder of --result-dir. Raises ConfigError, which names the option."""
    from gradysim.config.error import ConfigError

    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = "it is a file" if directory.is_file() else error.strerror or str(error)
        raise ConfigError(f"--result-dir {directory}: {reason}; expected a folder, or a new name") from error


def say_mistake(mistake: Exception) -> int:
    """Say what the user got wrong, without a traceback, and return the exit code."""
    if isinstance(mistake, BrokenPipeError):
        raise mistake  # nobody's mistake: `main` deals with it
    print(mistake, file=sys.stderr)
    return MISTAKE


def load(
    file: Path, config: str, runs: str | None, settings: Sequence[str], seed: int | None = None
) -> "list[Scenario]":
    """Return one scenario per run. Raises ConfigError."""
    from gradysim.config.error import ConfigError
    from gradysim.config.keys.options import LARGEST_SEED
    from gradysim.config.scenario import load_scenarios

    scenarios = load_scenarios(file, config, runs, settings)
    if seed is None:
        return scenarios
    if not 0 <= seed <= LARGEST_SEED:
        raise ConfigError(f"--seed {seed}: it is out of range; expected 0 to {LARGEST_SEED}")
    last = max(scenario.run_number for scenario in scenarios)
    if seed + last > LARGEST_SEED:
        raise ConfigError(
            f"--seed {seed}: run {last} would have the seed {seed + last}; expected at most"
            f" {LARGEST_SEED - last}, since run N adds N"
        )
    return [replace(scenario, seed=seed + scenario.run_number) for scenario in scenarios]


def simulator(mode: Mode) -> "tuple[Callable[[Scenario], None], Callable[[Scenario], Run]]":
    """Return what checks a scenario for `mode` and what builds its run; the other mode is not imported."""
    if mode == "prototype":
        from gradysim.prototype.run import PrototypeRun
        from gradysim.prototype.simulation import check_scenario

        return check_scenario, PrototypeRun
    from gradysim.integrated.network import check_scenario
    from gradysim.integrated.run import IntegratedRun

    return check_scenario, IntegratedRun


def capturing_simulator(
    mode: Mode, pcap: Sequence[str], result_dir: Path | None
) -> "tuple[Callable[[Scenario], None], Callable[[Scenario], Run]]":
    """The same for runs that write capture files. Raises ConfigError for a mode without frames."""
    from gradysim.config.error import ConfigError

    if mode == "prototype":
        raise ConfigError(
            f"--pcap {pcap[0]}: prototype mode has no frames to capture; expected --mode integrated"
        )
    from gradysim.integrated.network import check_scenario
    from gradysim.integrated.run import IntegratedRun

    def check(scenario: "Scenario") -> None:
        check_scenario(scenario)
        captures(scenario, pcap, result_dir)

    return check, lambda scenario: IntegratedRun(scenario, captures(scenario, pcap, result_dir))


def captures(scenario: "Scenario", pcap: Sequence[str], result_dir: Path | None) -> dict[int, Path]:
    """Return {id of a node: its capture file} of one run. Raises ConfigError for an unknown name."""
    from gradysim.integrated.capture import capture_files

    return capture_files(scenario, pcap, Path("results") if result_dir is None else result_dir)


def files_written(scenario: "Scenario", captures: Mapping[int, Path]) -> Iterable[Path]:
    """Return the capture files of all radios of these nodes."""
    from gradysim.integrated.capture import files_of_interfaces

    return files_of_interfaces(scenario, captures).values()


def run_one(
    build: "Callable[[Scenario], Run]", scenario: "Scenario", should_stop: Callable[[], bool], *, bar: bool
) -> "Outcome":
    """Carry out one run, with a progress bar if `bar` and the error output is a terminal."""
    from rich.console import Console

    from gradysim.report.supervised_run import carry_out

    console = Console(stderr=True) if bar and sys.stderr.isatty() else None
    return carry_out(build, scenario, should_stop, console)


def report(outcome: "Outcome", output: TextIO, result_dir: Path | None, *, as_json: bool) -> int:
    """Show and write what came out of a run, and return the exit code."""
    from gradysim.report.failure import print_failure
    from gradysim.results.run_file import write_run_file

    if outcome.failure is not None:
        print_failure(outcome.failure, sys.stderr)
    if outcome.result is not None:
        show(outcome.result, output, as_json=as_json)
        if result_dir is not None:
            print(f"written to {write_run_file(outcome.result, result_dir)}")
    if outcome.failure is not None:
        return FAILED
    return INTERRUPTED if outcome.interrupted else OK


def say_unfinished(scenarios: "Sequence[Scenario]", done: int, how: str = "") -> None:
    """Say on the error output which of several runs are not there."""
    from gradysim.report.unfinished_runs import text_of_unfinished

    if len(scenarios) > 1:
        numbers = [scenario.run_number for scenario in scenarios]
        print(text_of_unfinished(scenarios[0].config, numbers, done, how), file=sys.stderr)


def show(result: "RunResult", output: TextIO, *, as_json: bool) -> None:
    """Print a result: a line of JSON, or the summary for people."""
    if as_json:
        print(json.dumps(result.to_json_object()), file=output, flush=True)
        return
    from rich.console import Console

    from gradysim.report.summary import print_summary

    print_summary(result, Console(file=output))
    print(file=output)
