"""The runs of `gradysim run`, one after the other or at once: their output, in order, and the exit code."""

import sys
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from gradysim.cli.errors import (
    FAILED,
    INCOMPLETE,
    INTERRUPTED,
    LOCKED,
    MISTAKE,
    OK,
    OVER_MEMORY,
    abandon_output,
)

if TYPE_CHECKING:
    from concurrent.futures import Future

    from gradysim.cli.run_task import Reported
    from gradysim.scenario.load import Study

_MOST_SUBMITTED = 10_000
"""Number of runs submitted to an executor before the first of them has ended."""

_SHOW_CURSOR = "\r\x1b[?25h"
"""A progress bar hides the cursor, and a dead worker does not show it again."""


def run_all(study: "Study", left: Sequence[int], submit: "Callable[[int], Future[Reported]]") -> int:
    """Submit the runs at the positions `left`, print their output, and return the exit code of the command.

    `submit` passes the run at a position to an executor. After a run that does not end with OK, no other run
    starts. The death of a worker does not affect other runs: they continue. If standard output fails, the
    command ends with the files of all started runs.
    """
    from concurrent.futures import CancelledError

    from gradysim.cli.executors import WorkersLostError

    submitted: deque[tuple[int, Future[Reported]]] = deque()
    remaining = iter(left)
    is_over = False

    def cancel_others(ended: "Future[Reported]") -> None:
        if not ended.cancelled() and not may_others_go_on(ended):
            cancel()

    def cancel() -> None:
        nonlocal is_over
        is_over = True
        for _, future in submitted:
            future.cancel()

    def submit_more() -> None:
        while not is_over and len(submitted) < _MOST_SUBMITTED:
            place = next(remaining, None)
            if place is None:
                return
            future = submit(place)
            submitted.append((place, future))
            future.add_done_callback(cancel_others)

    codes: dict[int, int] = {}
    output_error: OSError | None = None

    def show(place: int, future: "Future[Reported]") -> None:
        nonlocal output_error
        number = study.numbers[place]
        with suppress(CancelledError):
            codes[number], error = _shown(future, f"{study.config} run {number}")
            if error is not None and output_error is None:
                output_error = error
                abandon_output()
                cancel()

    lost: WorkersLostError | None = None
    try:
        submit_more()
        while submitted:
            show(*submitted[0])
            submitted.popleft()
            submit_more()
    except KeyboardInterrupt:  # the third one
        cancel()
    except WorkersLostError as error:
        cancel()
        lost = error
    under_way = [study.numbers[place] for place, future in submitted if future.running()]
    for place, future in submitted:
        if future.done():
            show(place, future)
    complete = len(codes) == len(left) and not any(codes.values())
    with suppress(OSError):  # standard error may fail, too
        if output_error is not None and not (complete and isinstance(output_error, BrokenPipeError)):
            print(f"standard output: {output_error.strerror}", file=sys.stderr)
        if not complete:
            _print_unfinished(study, left, codes, under_way, lost)
    if output_error is not None:
        return OK if complete and isinstance(output_error, BrokenPipeError) else MISTAKE
    if lost is not None:
        return INCOMPLETE
    return OK if complete else _exit_code(list(codes.values()), len(left))


_OTHERS_GO_ON = {OK, LOCKED, OVER_MEMORY}
"""Exit codes of runs that do not stop the others."""


def may_others_go_on(ended: "Future[Reported]") -> bool:
    """Return whether other runs may start after one that ended so."""
    from gradysim.cli.runner import WorkerError

    error = ended.exception()
    if error is not None:
        return isinstance(error, WorkerError) and error.exit_code is not None
    code, output_error = ended.result()
    return code in _OTHERS_GO_ON and output_error is None


def _exit_code(codes: Sequence[int], run_count: int) -> int:
    """Return the exit code of runs that are not all OK: the first failure, then the reason to stop."""
    failed = [code for code in codes if code not in (*_OTHERS_GO_ON, INTERRUPTED)]
    if failed:
        return failed[0]
    if INTERRUPTED in codes or len(codes) < run_count:
        return INTERRUPTED
    return OVER_MEMORY if OVER_MEMORY in codes else LOCKED


def _shown(future: "Future[Reported]", name: str) -> "Reported":
    """Wait for a run, print its output, and return what its task returned."""
    from gradysim.cli.runner import RunFuture, WorkerError

    told, output_error = "", None
    try:
        code, output_error = future.result()
    except WorkerError as error:
        code = MISTAKE if error.exit_code is None else FAILED
        told = f"{_SHOW_CURSOR if sys.stderr.isatty() else ''}{name}: {error}\n"
    printed = future.printed if isinstance(future, RunFuture) else ()
    output, error_output = [text.decode("utf-8", errors="replace") for text in printed] or ("", "")
    with suppress(OSError):  # output fails, but the other runs must end
        print(error_output + told, end="", file=sys.stderr, flush=True)
    try:
        print(output, end="", flush=True)
    except OSError as error:
        output_error = error
    return code, output_error


_ENDED = {INTERRUPTED: "was interrupted", LOCKED: "was left out"}


def _print_unfinished(
    study: "Study",
    left: Sequence[int],
    codes: Mapping[int, int],
    under_way: Sequence[int],
    lost: Exception | None,
) -> None:
    """Print to standard error which of several runs are missing, in one line that begins with `lost`.

    `codes` are those of the runs that have ended. Those `under_way` were killed, or their end is not known.
    """
    line = [] if lost is None else [str(lost)]
    if len(left) > 1:
        numbers = [study.numbers[place] for place in left]
        done = [number for number in numbers if codes.get(number) == OK]
        known = {*codes, *under_way}
        missing = [number for number in numbers if number not in known]
        ended = {number: _ENDED.get(code, "failed") for number, code in sorted(codes.items()) if code != OK}
        line.append(text_of_unfinished(study.config, done, ended, missing, under_way))
    if line:
        print("; ".join(line), file=sys.stderr)


def text_of_unfinished(
    config: str,
    done: Sequence[int],
    ended: Mapping[int, str],
    left: Sequence[int],
    under_way: Sequence[int] = (),
) -> str:
    """Return which runs of `config` are done, which `ended` otherwise, and which are `under_way` or `left`.

    Numbers are in increasing order. `ended` is "failed" or "was interrupted".
    """
    which = [f"run {number} {how}" for number, how in ended.items()]
    count = len(done) + len(ended) + len(under_way) + len(left)
    which.append(f"{len(done)} of {count} runs {'is' if len(done) == 1 else 'are'} done{_numbers(done)}")
    for numbers, what in ((under_way, "under way"), (left, "not begun")):
        if numbers:
            which.append(f"{len(numbers)} {'was' if len(numbers) == 1 else 'were'} {what}{_numbers(numbers)}")
    return f"{config}: {', '.join(which)}"


def _numbers(numbers: Sequence[int]) -> str:
    from gradysim.scenario.runs import text_of_runs

    return f" ({text_of_runs(numbers)})" if numbers else ""
