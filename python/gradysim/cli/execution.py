"""One run of `gradysim run`: carried out, shown and written. It keeps what it computed, however it ends."""

import json
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, TextIO

from gradysim.cli.crash_report import print_failure
from gradysim.cli.exit_code import FAILED, INTERRUPTED, OK
from gradysim.cli.interrupt import StopOnInterrupt
from gradysim.integrated.compiled_part import CompiledPartMissingError
from gradysim.scenario.errors.config_error import ConfigError

if TYPE_CHECKING:
    from rich.console import Console

    from gradysim.results.result import RunResult
    from gradysim.scenario.lint import Finding
    from gradysim.scenario.scenario import Scenario


class Run(Protocol):
    """A run of either mode, built and ready."""

    def execute(
        self,
        progress: Callable[[float], None] | None = None,
        should_stop: Callable[[], bool] | None = None,
    ) -> None:
        """Run to the end; raise what a protocol raises."""

    def result(self) -> "RunResult":
        """Return what has been computed up to now."""

    def findings(self) -> "list[Finding]":
        """Return what lint checks found in the protocols up to now."""


@dataclass(frozen=True)
class Outcome:
    """How a run ended, and what it computed until then.

    Attributes:
        result: None if the run could not even be built.
        failure: What a protocol raised, in a callback or when it was made.
        interrupted: Whether Ctrl-C ended it.
        findings: What lint checks found in the protocols.
    """

    result: "RunResult | None"
    failure: BaseException | None = None
    interrupted: bool = False
    findings: "Sequence[Finding]" = ()


def execute(
    build: "Callable[[Scenario], Run]",
    scenario: "Scenario",
    interrupt: StopOnInterrupt,
    terminal: "Console | None",
) -> Outcome:
    """Build and execute a run, with a progress bar if there is a terminal.

    Raises:
        ConfigError, CompiledPartMissingError: The scenario or the installation is wrong.
        KeyboardInterrupt: Ctrl-C was pressed before the run was built.
    """
    from gradysim.cli.waiting import waiting

    try:
        with (
            interrupt.at_once(),
            waiting(f"building {len(scenario.nodes):,} nodes", shown=terminal is not None),
        ):
            run = build(scenario)
    except (ConfigError, CompiledPartMissingError, KeyboardInterrupt):
        raise
    except BaseException as failure:
        return Outcome(None, failure=failure)
    try:
        if terminal is None:
            run.execute(None, interrupt.should_stop)
        else:
            from gradysim.cli.progress import RunProgress

            title = f"{scenario.config} run {scenario.run_number}"
            with RunProgress(terminal, title, scenario.sim_time_limit_s) as bar:
                run.execute(bar.update, interrupt.should_stop)
    except KeyboardInterrupt:
        return Outcome(run.result(), interrupted=True, findings=run.findings())
    except BaseException as failure:  # SystemExit and asyncio.CancelledError are no Exception
        return Outcome(run.result(), failure=failure, findings=run.findings())
    result = run.result()
    return Outcome(result, interrupted=result.interrupted, findings=run.findings())


def report(
    outcome: Outcome, write: "Callable[[RunResult], Iterable[str]]", *, as_json: bool, quiet: bool
) -> tuple[int, OSError | None]:
    """Write and show what came out of a run, only JSON if it is to be `quiet`.

    `write` makes the files of a result, and gives a line about each. Files come first: standard output may
    take no more. Why a run failed comes last, where it is seen even if tables fill the screen.

    Returns the exit code, and the error if standard output takes no more.
    """
    output_error = None
    if outcome.result is not None:
        lines: list[str] = []
        try:
            lines.extend(write(outcome.result))
        finally:  # also if the disk is full
            try:
                if as_json or not quiet:
                    show(outcome.result, sys.stdout, as_json=as_json)
                for line in lines if not quiet else ():
                    print(line, file=sys.stderr if as_json else sys.stdout)
                sys.stdout.flush()
            except OSError as error:
                output_error = error
    if outcome.failure is not None:
        print_failure(outcome.failure, sys.stderr)
        return FAILED, output_error
    return INTERRUPTED if outcome.interrupted else OK, output_error


def show(result: "RunResult", output: TextIO, *, as_json: bool) -> None:
    """Print a result: a line of JSON, or the summary for people."""
    if as_json:
        print(json.dumps(result.to_json_object()), file=output)
        return
    from gradysim.cli.console import console
    from gradysim.cli.summary import print_summary

    print_summary(result, console(output))
    print(file=output)
