"""The output of several runs, in order, and the exit code of their command."""

import sys
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from itertools import chain

from gradysim.cli.errors import INCOMPLETE, INTERRUPTED, LOCKED, MISTAKE, OK, OVER_MEMORY, abandon_output
from gradysim.cli.executor import Row, RunExecutor, WorkersLostError
from gradysim.scenario.resolve.runs import text_of_runs

_SHOW_CURSOR = "\r\x1b[?25h"
"""A progress bar hides the cursor, and a dead worker does not show it again."""


def run_all(
    config: str,
    numbers: Sequence[int],
    executor: RunExecutor,
    on_progress: Callable[[int, int], None] | None = None,
) -> int:
    """Compute the runs of these numbers, print their output, and return the exit code of the command.

    After a run that does not end with OK, no other run starts. The death of a worker does not affect other
    runs: they continue. If standard output fails, the command ends with the files of all started runs.
    `on_progress` is called with the number of runs that have ended, and that of all.
    """
    unshown = deque(numbers)
    rows: dict[int, Row] = {}
    codes: dict[int, int] = {}
    output_error: OSError | None = None
    lost: WorkersLostError | None = None

    def show(row: Row) -> None:
        nonlocal output_error
        code, error = _shown(row, config)
        codes[row.number] = code
        if error is not None and output_error is None:
            output_error = error
            abandon_output()
            executor.stop()

    try:
        for ended in chain([()], executor.rows(numbers)):
            rows.update({row.number: row for row in ended})
            while unshown and unshown[0] in rows:
                show(rows[unshown[0]])
                del rows[unshown.popleft()]
            if on_progress is not None:
                on_progress(len(codes) + len(rows), len(numbers))
    except KeyboardInterrupt:  # the third press
        pass
    except WorkersLostError as error:
        lost = error
    for number in sorted(rows):
        show(rows[number])
    under_way = [number for number in executor.under_way if number not in codes]
    complete = len(codes) == len(numbers) and not any(codes.values())
    with suppress(OSError):  # standard error may fail, too
        if output_error is not None and not (complete and isinstance(output_error, BrokenPipeError)):
            print(f"standard output: {output_error.strerror}", file=sys.stderr)
        reasons = [] if lost is None else [str(lost)]
        if not complete and len(numbers) > 1:
            reasons.append(text_of_unfinished(config, numbers, codes, under_way))
        if reasons:
            print("; ".join(reasons), file=sys.stderr)
    if output_error is not None:
        return OK if complete and isinstance(output_error, BrokenPipeError) else MISTAKE
    if lost is not None:
        return INCOMPLETE
    return OK if complete else _exit_code([codes.get(number, INTERRUPTED) for number in numbers])


def _exit_code(codes: Sequence[int]) -> int:
    """Return the exit code of runs that are not all OK: the first failure, then the reason to stop."""
    reasons = (OK, LOCKED, OVER_MEMORY, INTERRUPTED)  # the last one that occurs decides
    failed = next((code for code in codes if code not in reasons), None)
    return failed or max(codes, key=reasons.index)


def _shown(row: Row, config: str) -> tuple[int, OSError | None]:
    """Print the output of a run. Return its exit code, and the error if standard output takes no more."""
    output_error = row.output_error
    output, error_output = [text.decode("utf-8", errors="replace") for text in row.printed] or ("", "")
    if row.death:
        cursor = _SHOW_CURSOR if sys.stderr.isatty() else ""
        error_output += f"{cursor}{config} run {row.number}: {row.death}\n"
    with suppress(OSError):  # output fails, but the other runs must end
        print(error_output, end="", file=sys.stderr, flush=True)
    try:
        print(output, end="", flush=True)
    except OSError as error:
        output_error = error
    return row.code, output_error


_ENDED = {INTERRUPTED: "was interrupted", LOCKED: "was left out"}


def text_of_unfinished(
    config: str, numbers: Sequence[int], codes: Mapping[int, int], under_way: Sequence[int] = ()
) -> str:
    """Return how many of the runs are done, which of them ended otherwise, and which did not.

    `numbers` increase. `codes` are those of the runs that have ended. Those `under_way` were killed, or their
    end is not known.
    """
    which = [f"run {number} {_ENDED.get(code, 'failed')}" for number, code in sorted(codes.items()) if code]
    done = [number for number in numbers if codes.get(number) == OK]
    which.append(f"{len(done)} of {len(numbers)} runs {'is' if len(done) == 1 else 'are'} done{_list(done)}")
    begun = {*codes, *under_way}
    missing = [number for number in numbers if number not in begun]
    for left, how in ((under_way, "under way"), (missing, "not begun")):
        if left:
            which.append(f"{len(left)} {'was' if len(left) == 1 else 'were'} {how}{_list(left)}")
    return f"{config}: {', '.join(which)}"


def _list(numbers: Sequence[int]) -> str:
    return f" ({text_of_runs(numbers)})" if numbers else ""
