"""One run of `gradysim run`: carried out, shown and written."""

import json
import sys
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, TextIO

from gradysim.cli.exit_code import FAILED, INTERRUPTED, OK

if TYPE_CHECKING:
    from gradysim.cli.interrupt import StopOnInterrupt
    from gradysim.cli.supervised_run import Outcome, Run
    from gradysim.results.result import RunResult
    from gradysim.scenario.scenario import Scenario


def run_one(
    build: "Callable[[Scenario], Run]", scenario: "Scenario", interrupt: "StopOnInterrupt", *, bar: bool
) -> "Outcome":
    """Carry out one run, with a progress bar if `bar` and the error output is a terminal.

    Raises KeyboardInterrupt if Ctrl-C is pressed before it is built.
    """
    from rich.console import Console

    from gradysim.cli.supervised_run import carry_out
    from gradysim.cli.waiting import waiting

    def build_it(scenario: "Scenario") -> "Run":
        with interrupt.at_once(), waiting(f"building {len(scenario.nodes):,} nodes", shown=bar):
            return build(scenario)

    console = Console(stderr=True) if bar and sys.stderr.isatty() else None
    return carry_out(build_it, scenario, interrupt.should_stop, console)


def report(
    outcome: "Outcome",
    output: TextIO,
    write: "Callable[[RunResult], Iterable[str]]",
    *,
    as_json: bool,
    quiet: bool,
) -> int:
    """Show and write what came out of a run, and return the exit code; show only JSON if it is to be `quiet`.

    `write` makes the files of a result, and gives a line about each.

    Why it failed comes last, where somebody looks whose screen the tables fill.
    """
    from gradysim.cli.failure import print_failure

    try:
        if outcome.result is not None:
            if as_json or not quiet:
                show(outcome.result, output, as_json=as_json)
            for line in write(outcome.result):
                if not quiet:
                    print(line)
            output.flush()
    finally:  # also if the output takes no more
        if outcome.failure is not None:
            print_failure(outcome.failure, sys.stderr)
    if outcome.failure is not None:
        return FAILED
    return INTERRUPTED if outcome.interrupted else OK


def show(result: "RunResult", output: TextIO, *, as_json: bool) -> None:
    """Print a result: a line of JSON, or the summary for people."""
    if as_json:
        print(json.dumps(result.to_json_object()), file=output)
        return
    from gradysim.cli.console import console
    from gradysim.cli.summary import print_summary

    print_summary(result, console(output))
    print(file=output)
