"""The runs of a configuration: handed to an executor, shown in their order, and what is left undone."""

import contextlib
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import CancelledError, Executor, Future
from typing import TYPE_CHECKING

from gradysim.cli.exit_code import FAILED, INTERRUPTED, MISTAKE, OK, abandon_output
from gradysim.cli.runner import RunFuture, WorkerError

if TYPE_CHECKING:
    from gradysim.scenario.scenario import Scenario

    Reported = tuple[int, OSError | None]
    """The exit code of a run, and the error if standard output takes no more."""

    CarryOut = Callable[[Scenario], Reported]

_SHOW_CURSOR = "\r\x1b[?25h"
"""A progress bar hides it, and a worker that dies leaves it so."""


def run_all(scenarios: "Sequence[Scenario]", carry_out: "CarryOut", executor: Executor) -> int:
    """Let `executor` carry out runs, and return the exit code of the command.

    `carry_out` writes and shows what came out of a run. After a run that does not end with OK no other one
    starts. A worker that dies says nothing about the runs of others: they go on. A standard output that takes
    no more ends the command, with the files of all runs that have started.
    """
    futures = [executor.submit(carry_out, scenario) for scenario in scenarios]

    def cancel_others(ended: "Future[Reported]") -> None:
        if not ended.cancelled() and not _may_others_go_on(ended):
            for future in futures:
                future.cancel()

    for future in futures:
        future.add_done_callback(cancel_others)
    codes: dict[int, int] = {}
    output_error: OSError | None = None
    with executor:
        try:
            for index, (scenario, future) in enumerate(zip(scenarios, futures, strict=True)):
                with contextlib.suppress(CancelledError):
                    codes[index], error = _shown(future, f"{scenario.config} run {scenario.run_number}")
                    if error is not None and output_error is None:
                        output_error = error
                        abandon_output()
                        for other in futures:
                            other.cancel()
        except KeyboardInterrupt:  # which kills the workers
            pass
    complete = len(codes) == len(scenarios) and not any(codes.values())
    if output_error is not None and not (complete and isinstance(output_error, BrokenPipeError)):
        print(f"standard output: {output_error.strerror}", file=sys.stderr)
    if not complete:
        _print_unfinished(scenarios, codes)
    if output_error is not None:
        return OK if complete and isinstance(output_error, BrokenPipeError) else MISTAKE
    return OK if complete else next((c for c in codes.values() if c not in (OK, INTERRUPTED)), INTERRUPTED)


def _may_others_go_on(ended: "Future[Reported]") -> bool:
    error = ended.exception()
    if error is not None:
        return isinstance(error, WorkerError) and error.exit_code is not None
    return ended.result() == (OK, None)


def _shown(future: "Future[Reported]", name: str) -> "Reported":
    """Wait for a run, show what it printed, and return what `carry_out` does."""
    told, output_error = "", None
    try:
        code, output_error = future.result()
    except WorkerError as error:
        code = MISTAKE if error.exit_code is None else FAILED
        told = f"{_SHOW_CURSOR if sys.stderr.isatty() else ''}{name}: {error}\n"
    printed = future.printed if isinstance(future, RunFuture) else ()
    output, error_output = [text.decode("utf-8", errors="replace") for text in printed] or ("", "")
    print(error_output + told, end="", file=sys.stderr, flush=True)
    try:
        print(output, end="", flush=True)
    except OSError as error:
        output_error = error
    return code, output_error


def check_jobs(jobs: int) -> None:
    """Raise ConfigError for a number of runs at once that cannot be, before anything is read."""
    from gradysim.scenario.errors import ConfigError

    if jobs < 1:
        raise ConfigError(f"--jobs {jobs}: it is out of range; expected 1 or more")
    if jobs > 1 and not hasattr(os, "fork"):
        raise ConfigError(f"--jobs {jobs}: this system cannot fork a process; expected --jobs 1")


def _print_unfinished(scenarios: "Sequence[Scenario]", codes: Mapping[int, int]) -> None:
    """Say on the error output which of several runs are missing; `codes` are those of the runs that began."""
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


def text_of_unfinished(
    config: str, done: Sequence[int], ended: Mapping[int, str], left: Sequence[int]
) -> str:
    """Say which runs of `config` are done, which `ended` otherwise and how, and which are `left`.

    The numbers of each increase; how a run ended is "failed" or "was interrupted".
    """
    which = [f"run {number} {how}" for number, how in ended.items()]
    count = len(done) + len(ended) + len(left)
    which.append(f"{len(done)} of {count} runs {'is' if len(done) == 1 else 'are'} done{_numbers(done)}")
    if left:
        which.append(f"{len(left)} {'was' if len(left) == 1 else 'were'} not begun{_numbers(left)}")
    return f"{config}: {', '.join(which)}"


def _numbers(numbers: Sequence[int]) -> str:
    from gradysim.scenario.runs import text_of_runs

    return f" ({text_of_runs(numbers)})" if numbers else ""
