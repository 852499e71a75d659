"""One run of `gradysim run`: validated, built, executed and reported. It keeps its results in all cases."""

import json
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Protocol, TextIO

from rich.console import Console

from gradysim.cli.console import console
from gradysim.cli.errors import FAILED, INTERRUPTED, MISTAKE, OK, print_failure
from gradysim.cli.interrupt import StopOnInterrupt
from gradysim.cli.memory import limited
from gradysim.cli.options import RunOptions
from gradysim.cli.output import captures_under_way, ids_of_outcomes, log_level, nodes_of_vectors, replay_sink
from gradysim.cli.progress import RunProgress, waiting
from gradysim.cli.summary import print_summary, run_line
from gradysim.integrated.compiled_part import CompiledPartMissingError
from gradysim.replay.sink import OutputError
from gradysim.results.result import RunResult
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.lint import Finding
from gradysim.scenario.scenario import Scenario, check_node_names


class Check(Protocol):
    """Validates a scenario. ConfigError names what is invalid."""

    def __call__(self, scenario: Scenario, *, is_built_next: bool) -> None:
        """Validate a scenario.

        With `is_built_next`, skip the checks of the build, which checks the network.
        """


class Run(Protocol):
    """A run of either mode, ready to execute."""

    def execute(
        self,
        progress: Callable[[float], None] | None = None,
        should_stop: Callable[[], bool] | None = None,
    ) -> None:
        """Run to the end. Exceptions of protocols are raised."""

    def result(self) -> RunResult:
        """Return the results so far."""

    def findings(self) -> list[Finding]:
        """Return the findings of lint checks of the protocols so far."""

    @property
    def lacks_output(self) -> bool:
        """Whether a capture or a replay lacks its end."""


@dataclass(frozen=True)
class Outcome:
    """How a run ended, and its results until then.

    Attributes:
        result: None if the run could not be built.
        failure: Exception of a protocol, in a callback or in its constructor; the KeyboardInterrupt if a
            second Ctrl-C ended it.
        interrupted: Whether Ctrl-C, SIGTERM or SIGHUP ended it.
        findings: Findings of lint checks of the protocols.
        lacks_output: Whether a capture or a replay lacks its end.
    """

    result: RunResult | None
    failure: BaseException | None = None
    interrupted: bool = False
    findings: Sequence[Finding] = ()
    lacks_output: bool = False

    @staticmethod
    def of(run: Run, failure: BaseException | None = None, *, interrupted: bool = False) -> "Outcome":
        """Return how a run ended that was built."""
        result = run.result()
        return Outcome(result, failure, interrupted, run.findings(), run.lacks_output)


def execute(
    build: Callable[[Scenario], Run],
    scenario: Scenario,
    interrupt: StopOnInterrupt,
    terminal: Console | None,
    memory_bytes: int | None = None,
) -> Outcome:
    """Build and execute a run, with a progress bar on a terminal and a memory limit.

    Raises:
        ConfigError, CompiledPartMissingError: The scenario or the installation is not valid.
        KeyboardInterrupt: Ctrl-C was pressed before the run was built.
    """
    try:
        with (
            interrupt.at_once(),
            limited(memory_bytes),
            waiting(f"building {len(scenario.nodes):,} nodes", shown=terminal is not None),
        ):
            run = build(scenario)
    except (ConfigError, CompiledPartMissingError, KeyboardInterrupt):
        raise
    except BaseException as failure:
        return Outcome(None, failure=failure)
    try:
        with limited(memory_bytes), interrupt.executing():
            if terminal is None:
                run.execute(None, interrupt.should_stop)
            else:
                title = f"{scenario.config} run {scenario.run_number}"
                with RunProgress(terminal, title, scenario.sim_time_limit_s) as bar:
                    run.execute(bar.update, interrupt.should_stop)
    except KeyboardInterrupt as pressed:
        return Outcome.of(run, pressed, interrupted=True)
    except BaseException as failure:  # also SystemExit and asyncio.CancelledError
        return Outcome.of(run, failure)
    return Outcome.of(run, interrupted=run.result().interrupted)


def report(
    outcome: Outcome,
    write: Callable[[RunResult, bool], Iterable[str]],
    options: RunOptions,
    which: str | None = None,
) -> tuple[int, OSError | None]:
    """Write and print the results of a run. With --json, print JSON only.

    Files come first, since standard output may fail. The reason of a failure comes last, where it is visible
    below the tables.

    Args:
        outcome: Outcome of the run.
        write: Writes the files of a result, and yields a line about each. The second argument says whether a
            capture or a replay lacks its end.
        options: Options of the command.
        which: Label of one run of several: it is shown in one line, without its files.

    Returns:
        The exit code, and the error if standard output fails.
    """
    quiet, as_json = options.quiet, options.as_json
    output_error = None
    if outcome.result is not None:
        lines: list[str] = []
        try:
            lines.extend(write(outcome.result, outcome.lacks_output))
        finally:  # also if the disk is full
            try:
                if as_json or not quiet:
                    show(outcome.result, sys.stdout, options, which)
                for line in lines if not quiet and (as_json or which is None) else ():
                    print(line, file=sys.stderr if as_json else sys.stdout)
                sys.stdout.flush()
            except OSError as error:
                output_error = error
    if outcome.failure is not None:
        print_failure(outcome.failure, sys.stderr)
    if outcome.interrupted:
        return INTERRUPTED, output_error
    return _code_of(outcome.failure), output_error


def _code_of(failure: BaseException | None) -> int:
    """Return the exit code of a run that was not interrupted."""
    if failure is None:
        return OK
    return MISTAKE if isinstance(failure, OutputError) else FAILED


def show(result: RunResult, output: TextIO, options: RunOptions, which: str | None) -> None:
    """Print a result: a line of JSON, a line of text if it is one of several runs, or the summary."""
    if options.as_json:
        print(json.dumps(result.to_json_object()), file=output)
        return
    if which is not None:
        print(run_line(result, which, console(output).width), file=output)
        return
    print_summary(result, console(output), details=options.details)
    print(file=output)


def simulator(options: RunOptions) -> tuple[Check, Callable[[Scenario], Run]]:
    """Return the functions that check a scenario and build its run. The other mode is not imported.

    Raises ConfigError for options that need frames in a mode without frames.
    """
    if options.mode == "prototype":
        from gradysim.prototype.run import PrototypeRun
        from gradysim.prototype.simulation import check_scenario

        require_no_names("--pcap", options.pcap, "no frames to capture")
        require_no_names("--outcomes-at", options.outcomes_at, "no outcomes of frames")

        def check_all(scenario: Scenario, *, is_built_next: bool) -> None:
            check_scenario(scenario)

        def build_prototype(scenario: Scenario) -> Run:
            return PrototypeRun(
                scenario,
                vectors_of=[node.id for node in nodes_of_vectors(scenario, options)],
                replay=replay_sink(scenario, options),
                log_level=log_level(options),
            )

        return check_all, build_prototype

    from gradysim.integrated.network import check_scenario as check_network
    from gradysim.integrated.run import IntegratedRun

    def check(scenario: Scenario, *, is_built_next: bool) -> None:
        if not is_built_next:
            check_network(scenario)

    def build(scenario: Scenario) -> Run:
        return IntegratedRun(
            scenario,
            captures_under_way(scenario, options),
            outcomes_at=ids_of_outcomes(scenario, options),
            vectors_of=[node.id for node in nodes_of_vectors(scenario, options)],
            replay=replay_sink(scenario, options),
            log_level=log_level(options),
        )

    return check, build


def require_no_names(option: str, names: Iterable[str], reason: str) -> None:
    """Raise ConfigError if an option that prototype mode does not support has names of nodes."""
    for name in names:
        raise ConfigError(f"{option} {name}: prototype mode has {reason}; expected --mode integrated")


def check_names(scenarios: Sequence[Scenario], options: RunOptions, run_count: int) -> None:
    """Raise ConfigError for a name in an option that no node of `run_count` runs has.

    `scenarios` are runs that have all nodes.
    """
    for option, names in (
        ("--pcap", options.pcap),
        ("--outcomes-at", options.outcomes_at),
        ("--vectors", options.vectors),
        ("--replay", options.replay),
        ("--trace", options.trace),
    ):
        check_node_names(scenarios, names, option, run_count)
