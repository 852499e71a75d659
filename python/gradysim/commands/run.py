"""`gradysim run`: carries out runs one after the other, and says what came out."""

import contextlib
import json
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TextIO

from cyclopts import Parameter

from gradysim.commands.arguments import ConfigOption, FileArgument, Mode, SetOption, WholeNumber
from gradysim.commands.exit_code import FAILED, INTERRUPTED, OK, say_mistake
from gradysim.commands.scenarios import load
from gradysim.commands.simulators import captures, files_written, ids_of_fates, simulator
from gradysim.commands.sudden_end import tell_of_crashes, told_of_exit
from gradysim.commands.warnings import (
    warn_of_doubtful_times,
    warn_of_equal_seeds,
    warn_of_mission_speeds,
    warn_of_shadowed_lines,
    warn_of_what_is_seldom_meant,
)

if TYPE_CHECKING:
    from gradysim.config.scenario import Scenario
    from gradysim.report.interrupt import StopOnInterrupt
    from gradysim.report.supervised_run import Outcome, Run
    from gradysim.results.run_result import RunResult

    CarryOut = Callable[[Scenario, StopOnInterrupt, TextIO], int]


def _of_nodes(help_text: str) -> Parameter:
    """Describe an option that takes the names of nodes."""
    return Parameter(
        negative="",
        consume_multiple=(1, None),
        show_default=False,
        help=f"NODE...: {help_text} A node (uavs[0]), a group (uavs), or all.",
    )


PcapOption = Annotated[
    tuple[str, ...],
    _of_nodes(
        "write what the radios of these nodes send and receive to DIR/CONFIG-#RUN-NODE.pcap"
        " (that of its wlan[1]: …-wlan1.pcap), DIR as in --result-dir (default: results)."
    ),
]

FatesAtOption = Annotated[
    tuple[str, ...],
    _of_nodes("tell what became of the frames that reached these nodes, and who interfered."),
]


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
        Mode,
        Parameter(
            help="The 802.11 network of the compiled engine, or the plain simulator in Python. Their messages"
            " reach 786 m and 60 m by default: `gradysim keys range`."
        ),
    ] = "integrated",
    settings: SetOption = (),
    seed: Annotated[
        WholeNumber | None,
        Parameter(help="Seed of run 0, to which run N adds N; by default the file's seed-set."),
    ] = None,
    result_dir: Annotated[
        Path | None, Parameter(help="Write each run's JSON object to DIR/CONFIG-#RUN.MODE.json.")
    ] = None,
    resume: Annotated[
        bool,
        Parameter(
            negative="",
            help="Leave out runs whose file in --result-dir is complete and of the same settings, seed and"
            " files (protocols, obstacles), with what --pcap and --fates-at ask for.",
        ),
    ] = False,
    jobs: Annotated[
        WholeNumber, Parameter(alias="-j", help="How many runs at once, each in a process of its own.")
    ] = 1,
    pcap: PcapOption = (),
    fates_at: FatesAtOption = (),
    as_json: Annotated[
        bool,
        Parameter(name="--json", negative="", help="Print one JSON object per run, one per line, no more."),
    ] = False,
    quiet: Annotated[
        bool, Parameter(negative="", help="No progress bar and no summaries: warnings and failures only.")
    ] = False,
) -> int:
    """Run the runs of a configuration and say what came out."""
    from gradysim.config.errors.config_error import ConfigError
    from gradysim.integrated.compiled_part import CompiledPartMissingError
    from gradysim.report.waiting import waiting

    output = sys.stdout
    bar = not quiet and not as_json
    # What protocols print, also when they are imported, must not get between the JSON objects.
    with contextlib.redirect_stdout(sys.stderr) if as_json else contextlib.nullcontext():
        try:
            if result_dir is not None:
                make_result_dir(result_dir)
            with waiting(f"reading {file}", shown=bar):
                scenarios = load(file, config, runs, settings, seed)
            check, build = simulator(mode, pcap, fates_at, result_dir)
            warn_of_equal_seeds(scenarios)
            if resume:
                scenarios = left_to_do(scenarios, mode, result_dir, fates_at, pcap)
                if not scenarios:
                    return OK
            if result_dir is not None:
                check_may_be_written_to(result_dir)
            warn_of_shadowed_lines(scenarios[0])
            warn_of_doubtful_times(scenarios)
            warn_of_mission_speeds(scenarios)
            with waiting(f"checking {config}", shown=bar):
                for scenario in scenarios:
                    check(scenario, is_built_next=len(scenarios) == 1)
            if mode == "integrated":
                warn_of_what_is_seldom_meant(scenarios)

            def carry_out(scenario: "Scenario", interrupt: "StopOnInterrupt", output: TextIO) -> int:
                outcome = run_one(build, scenario, interrupt, bar=bar and jobs == 1)
                code = report(outcome, output, result_dir, as_json=as_json, quiet=quiet)
                if pcap and outcome.result is not None and not quiet:
                    for capture in files_written(scenario, captures(scenario, pcap, result_dir)):
                        print(f"captured in {capture}")
                return code

            if jobs == 1:
                return one_after_the_other(scenarios, carry_out, output)
            return several_at_once(scenarios, carry_out, output, jobs)
        except (ConfigError, CompiledPartMissingError, OSError) as mistake:
            return say_mistake(mistake)


def one_after_the_other(scenarios: "Sequence[Scenario]", carry_out: "CarryOut", output: TextIO) -> int:
    """Carry out runs up to the first that fails or is interrupted; return the exit code of the command."""
    from gradysim.report.interrupt import StopOnInterrupt

    tell_of_crashes()
    with StopOnInterrupt() as interrupt:
        for done, scenario in enumerate(scenarios):
            if interrupt.should_stop():  # pressed between two runs
                say_unfinished(scenarios, dict.fromkeys(range(done), OK))
                return INTERRUPTED
            codes = dict.fromkeys(range(done), OK)
            say_failed = partial(say_unfinished, scenarios, {**codes, done: FAILED})
            try:
                with told_of_exit(f"{scenario.config} run {scenario.run_number}", say_failed):
                    code = carry_out(scenario, interrupt, output)
            except KeyboardInterrupt:  # while it was built
                say_unfinished(scenarios, codes)
                return INTERRUPTED
            if code != OK:
                say_unfinished(scenarios, {**codes, done: code})
                return code
    return OK


def several_at_once(scenarios: "Sequence[Scenario]", carry_out: "CarryOut", output: TextIO, jobs: int) -> int:
    """Carry out runs in `jobs` processes; return the exit code of the command."""
    from gradysim.config.errors.config_error import ConfigError
    from gradysim.integrated.compiled_part import CompiledPartMissingError

    if jobs < 1:
        raise ConfigError(f"--jobs {jobs}: it is out of range; expected 1 or more")
    if not hasattr(os, "fork"):
        raise ConfigError(f"--jobs {jobs}: this system cannot divide a process into two; expected --jobs 1")
    from gradysim.commands.processes import in_processes

    def work(index: int, interrupt: "StopOnInterrupt", output: TextIO) -> int:
        try:
            return carry_out(scenarios[index], interrupt, output)
        except KeyboardInterrupt:  # while it was built
            return INTERRUPTED
        except (ConfigError, CompiledPartMissingError, OSError) as mistake:
            return say_mistake(mistake)

    tell_of_crashes()
    names = [f"{scenario.config} run {scenario.run_number}" for scenario in scenarios]
    codes = in_processes(work, names, jobs, output)
    if len(codes) < len(scenarios) or any(codes.values()):
        say_unfinished(scenarios, codes)
        return next((code for code in codes.values() if code not in (OK, INTERRUPTED)), INTERRUPTED)
    return OK


def make_result_dir(directory: Path) -> None:
    """Make the folder of --result-dir. Raises ConfigError, which names the option."""
    from gradysim.config.errors.config_error import ConfigError

    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = "it is no folder" if os.path.lexists(directory) else error.strerror or str(error)
        raise ConfigError(f"--result-dir {directory}: {reason}; expected a folder, or a new name") from error


def check_may_be_written_to(directory: Path) -> None:
    """Raise ConfigError, which names the option, before a run that takes hours finds it out."""
    from gradysim.config.errors.config_error import ConfigError

    if not os.access(directory, os.W_OK | os.X_OK):
        raise ConfigError(f"--result-dir {directory}: it takes no files from you; expected another folder")


def left_to_do(
    scenarios: "Sequence[Scenario]",
    mode: Mode,
    result_dir: Path | None,
    fates_at: Sequence[str],
    pcap: Sequence[str],
) -> "list[Scenario]":
    """Return the runs that lack a result or a capture, and say which do not, and whose result is outdated.

    Raises ConfigError without a folder, and for names in `fates_at` and `pcap` that are none of nodes.
    """
    from gradysim.config.errors.config_error import ConfigError
    from gradysim.config.runs.file_hashes import text_of_files
    from gradysim.config.runs.run_numbers import text_of_runs
    from gradysim.results.run_file import files_changed_since

    if result_dir is None:
        raise ConfigError("--resume: there is no folder to look into; expected --result-dir DIR, too")
    left, done = [], []
    outdated: dict[tuple[str, ...], list[int]] = {}
    for scenario in scenarios:
        captured = all(
            file.is_file() for file in files_written(scenario, captures(scenario, pcap, result_dir))
        )
        changed = files_changed_since(scenario, mode, result_dir, ids_of_fates(scenario, fates_at))
        if changed == () and captured:
            done.append(scenario.run_number)
            continue
        left.append(scenario)
        if changed:
            outdated.setdefault(changed, []).append(scenario.run_number)
    for files, runs in outdated.items():
        print(
            f"{scenarios[0].config}: {text_of_files(files)} changed after {len(runs)} of {len(scenarios)}"
            f" runs in {result_dir} ({text_of_runs(runs)}), which begin anew",
            file=sys.stderr,
        )
    if done:
        print(
            f"{scenarios[0].config}: {len(done)} of {len(scenarios)} runs {'is' if len(done) == 1 else 'are'}"
            f" in {result_dir} ({text_of_runs(done)}) and left out",
            file=sys.stderr,
        )
    return left


def run_one(
    build: "Callable[[Scenario], Run]", scenario: "Scenario", interrupt: "StopOnInterrupt", *, bar: bool
) -> "Outcome":
    """Carry out one run, with a progress bar if `bar` and the error output is a terminal.

    Raises KeyboardInterrupt if Ctrl-C is pressed before it is built.
    """
    from rich.console import Console

    from gradysim.report.supervised_run import carry_out
    from gradysim.report.waiting import waiting

    def build_it(scenario: "Scenario") -> "Run":
        with interrupt.at_once(), waiting(f"building {len(scenario.nodes):,} nodes", shown=bar):
            return build(scenario)

    console = Console(stderr=True) if bar and sys.stderr.isatty() else None
    return carry_out(build_it, scenario, interrupt.should_stop, console)


def report(outcome: "Outcome", output: TextIO, result_dir: Path | None, *, as_json: bool, quiet: bool) -> int:
    """Show and write what came out of a run, and return the exit code; show only JSON if it is to be `quiet`.

    Why it failed comes last, where somebody looks whose screen the tables fill.
    """
    from gradysim.report.failure import print_failure
    from gradysim.results.run_file import write_run_file

    try:
        if outcome.result is not None:
            if as_json or not quiet:
                show(outcome.result, output, as_json=as_json)
            written = None if result_dir is None else write_run_file(outcome.result, result_dir)
            if written is not None and not quiet:
                print(f"written to {written}")
            output.flush()
    finally:  # also if the output takes no more
        if outcome.failure is not None:
            print_failure(outcome.failure, sys.stderr)
    if outcome.failure is not None:
        return FAILED
    return INTERRUPTED if outcome.interrupted else OK


def say_unfinished(scenarios: "Sequence[Scenario]", codes: Mapping[int, int]) -> None:
    """Say on the error output which of several runs are not there; `codes` are those of the runs begun."""
    from gradysim.report.unfinished_runs import text_of_unfinished

    if len(scenarios) > 1:
        numbers = [scenario.run_number for scenario in scenarios]
        done = [number for index, number in enumerate(numbers) if codes.get(index) == OK]
        left = [number for index, number in enumerate(numbers) if index not in codes]
        ended = {
            numbers[index]: "was interrupted" if code == INTERRUPTED else "failed"
            for index, code in sorted(codes.items())
            if code != OK
        }
        print(text_of_unfinished(scenarios[0].config, done, ended, left), file=sys.stderr)


def show(result: "RunResult", output: TextIO, *, as_json: bool) -> None:
    """Print a result: a line of JSON, or the summary for people."""
    if as_json:
        print(json.dumps(result.to_json_object()), file=output, flush=True)
        return
    from gradysim.report.console import console
    from gradysim.report.summary import print_summary

    print_summary(result, console(output))
    print(file=output)
