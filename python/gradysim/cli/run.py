"""`gradysim run`: checks the runs of a configuration, executes them, and reports their results."""

import gc
import os
import signal
import sys
import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, chdir, nullcontext, redirect_stdout, suppress
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.cli.earlier_results import check_other_settings, is_done, is_of_other_settings, left_to_do
from gradysim.cli.errors import (
    FAILED,
    INTERRUPTED,
    LOCKED,
    MISTAKE,
    OK,
    OVER_MEMORY,
    abandon_output,
    report_crashes,
    say_mistake,
)
from gradysim.cli.memory import checked_limit
from gradysim.cli.options import FileArgument, RunOptions, option_value
from gradysim.cli.output import (
    check_file_names,
    check_may_be_written_to,
    check_sqlite,
    files_under_way,
    make_result_dir,
    write_files,
)
from gradysim.cli.runs import check, findings_of, tell, warnings_of_seeds
from gradysim.cli.until import checked_until, rounds_of
from gradysim.cli.share import part_of_share

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

    from rich.console import Console

    from gradysim.scenario.load import Study
    from gradysim.scenario.scenario import Scenario

    Reported = tuple[int, OSError | None]
    """The exit code of a run, and the error if standard output takes no more."""

    CarryOut = Callable[[int], Reported]
    """Executes the run at a position of a study."""


DEFAULTS = RunOptions()

_MOST_SUBMITTED = 1000
"""Number of runs submitted to an executor before the first of them has ended."""

_LONGEST_S = 366 * 86400
"""Longest time of --stop-after: a year."""

_SHOW_CURSOR = "\r\x1b[?25h"
"""A progress bar hides the cursor, and a dead worker does not show it again."""


def run(file: FileArgument, /, *, options: RunOptions = DEFAULTS) -> int:
    """Run the runs of a configuration and report their results."""
    from gradysim.encapsulator.run_context import gc_paused

    with gc_paused():  # nothing of what is read is garbage
        return run_file(file, options)


def run_file(file: Path, options: RunOptions, executor: "Executor | None" = None) -> int:
    """Run `gradysim run` and return its exit code.

    Args:
        file: The .ini file.
        options: Options of the command.
        executor: Executes the runs; the caller shuts it down. By default each run has its own process. Calls
            passed to `submit` cannot be pickled.
    """
    from gradysim.cli.execution import check_names, execute, report, simulator
    from gradysim.cli.interrupt import StopOnInterrupt
    from gradysim.cli.progress import waiting
    from gradysim.cli.runner import ForkExecutor, keep_from_forks
    from gradysim.integrated.compiled_part import CompiledPartMissingError
    from gradysim.results.run_lock import RunLockedError, remove_left_over_files
    from gradysim.scenario.errors import ConfigError, ErrorCollector

    begin_s = time.monotonic()
    gc.freeze()  # excludes modules from the open files, which the runner searches
    bar = not options.quiet and not options.as_json
    try:
        check_jobs(options.jobs)
        memory_bytes = checked_limit(options.memory)
        until = checked_until(options)
        stop_after_s = checked_duration(options.stop_after)
        check_sqlite(options)
        if options.writes_files:
            make_result_dir(options.directory)
        # Output of protocols at import must not get between the JSON objects.
        with redirect_stdout(sys.stderr) if options.as_json else nullcontext():
            part = part_of_share(options.share)
            with waiting(f"reading {file}", shown=bar):
                study = check(file, options.config, options.runs, options.settings, options.seed, part)
                if not len(study):
                    print(f"{study.config}: --share {options.share} has no run", file=sys.stderr)
                    return OK
                checked = study.checked_in_full()
            check_network, build = simulator(options)
            check_names(checked, options, len(study))
            check_file_names(study, options)
            tell(warnings_of_seeds(study))
            left: Sequence[int] = range(len(study))
            if options.resume:
                left = left_to_do(study, options)
                if not left:
                    return OK
            check_other_settings(study, options)
            if options.writes_files:
                check_may_be_written_to(options.directory)
            with waiting(f"checking {options.config}", shown=bar):
                errors = ErrorCollector()
                for scenario in checked:
                    with errors.collecting():
                        check_network(scenario, is_built_next=len(left) == 1)
                errors.raise_all()
            tell(findings_of(checked, options.mode))
    except (ConfigError, CompiledPartMissingError, OSError) as mistake:
        return say_mistake(mistake)

    def carry_out(place: int) -> "Reported":
        gc.enable()
        name = f"{study.config} run {study.numbers[place]}"
        try:
            with lock_of(study, place, options):
                with redirect_stdout(sys.stderr) if options.as_json else nullcontext(), chdir("."):
                    scenario = study[place]
                    if options.resume and is_done(scenario, options):
                        print(f"{name}: another process has done it; left out", file=sys.stderr)
                        return OK, None
                    if is_of_other_settings(scenario, options):
                        print(
                            f"{name}: another process has done it with other settings; left out",
                            file=sys.stderr,
                        )
                        return MISTAKE, None
                    if executor is None and hasattr(os, "fork"):
                        keep_from_forks(files_under_way(scenario, options))
                    outcome = execute(build, scenario, interrupt, terminal, memory_bytes)
                if place == left[0]:
                    tell(outcome.findings)
                write = partial(write_files, scenario, options=options)
                line = begin_of_line(scenario) if has_lines else None
                code, output_error = report(outcome, write, options, line)
        except RunLockedError as locked:
            print(f"{name}: {locked}; left out", file=sys.stderr)
            return LOCKED, None
        except KeyboardInterrupt:  # while it was built
            return INTERRUPTED, None
        except (ConfigError, CompiledPartMissingError, OSError) as mistake:
            return say_mistake(mistake), None
        if memory_bytes is not None and isinstance(outcome.failure, MemoryError):
            print(f"{name}: it needs more than --memory {options.memory}", file=sys.stderr)
            return OVER_MEMORY, output_error
        return code, output_error

    has_lines = len(study) > 1 and not options.details
    begin_of_line = line_of_runs(study)
    report_crashes()
    terminal = error_terminal() if bar and options.jobs == 1 and not options.trace else None
    import_what_runs_use(options)
    if options.is_writer:
        remove_left_over_files(options.directory)
    left_s = None if stop_after_s is None else stop_after_s - (time.monotonic() - begin_s)
    with StopOnInterrupt(left_s) as interrupt:
        workers = ForkExecutor(options.jobs, interrupt) if executor is None else nullcontext(executor)
        with workers as chosen:
            try:
                for places in rounds_of(study, left, until, options):
                    code = run_all(study, places, carry_out, chosen)
                    if code != OK:
                        break
            except (ConfigError, OSError) as mistake:
                code = say_mistake(mistake)
        if options.is_writer:
            remove_left_over_files(options.directory)
    if code == INTERRUPTED:
        code = interrupt.exit_code
    if code == OK and has_lines and options.is_writer and not (options.as_json or options.quiet):
        print(f"files in {options.directory}")
    return code


def lock_of(study: "Study", place: int, options: RunOptions) -> AbstractContextManager[None]:
    """Return the lock of a run, if it writes files. Its `with` statement raises RunLockedError."""
    from gradysim.results.files import run_file as file_of
    from gradysim.results.run_lock import run_locked

    if not options.is_writer:
        return nullcontext()
    return run_locked(
        options.directory, file_of(Path(), study.config, study.numbers[place], options.mode).name
    )


def line_of_runs(study: "Study") -> "Callable[[Scenario], str]":
    """Return a function that returns the beginning of a run's line. All have the same length."""
    from gradysim.scenario.sweep import text_of_iterations

    number_width = len(str(study.numbers[-1]))
    values_width = study.width_of_iterations()

    def begin(scenario: "Scenario") -> str:
        values = f"{text_of_iterations(scenario.iterations)} #{scenario.repetition}".lstrip()
        return f"{study.config} run {scenario.run_number:{number_width}}  {values:{values_width}}"

    return begin


def error_terminal() -> "Console | None":
    """Return the terminal for a progress bar, if standard error is one."""
    if not sys.stderr.isatty():
        return None
    import rich.progress  # noqa: F401 (before processes are forked)
    from rich.console import Console

    return Console(stderr=True)


def import_what_runs_use(options: RunOptions) -> None:
    """Import the modules that report a run before a process is forked for each run."""
    names = []
    if not (options.as_json or options.quiet):
        names += ["gradysim.cli.console", "gradysim.cli.summary"]
    if options.writes_files:
        names.append("gradysim.results.files")
    if options.scalars or options.vectors:
        names.append("gradysim.results.omnetpp")
    for name in names:
        import_module(name)


def run_all(study: "Study", left: Sequence[int], carry_out: "CarryOut", executor: "Executor") -> int:
    """Let `executor` execute the runs at the positions `left`, and return the exit code of the command.

    `carry_out` writes and prints the results of a run. After a run that does not end with OK, no other run
    starts. The death of a worker does not affect other runs: they continue. If standard output fails, the
    command ends with the files of all started runs.
    """
    from concurrent.futures import CancelledError

    submitted: deque[tuple[int, Future[Reported]]] = deque()
    remaining = iter(left)
    is_over = False

    def cancel_others(ended: "Future[Reported]") -> None:
        if not ended.cancelled() and not _may_others_go_on(ended):
            cancel()

    def cancel() -> None:
        nonlocal is_over
        is_over = True
        for _, future in submitted:
            future.cancel()

    def submit() -> None:
        while not is_over and len(submitted) < _MOST_SUBMITTED:
            place = next(remaining, None)
            if place is None:
                return
            future = executor.submit(carry_out, place)
            submitted.append((place, future))
            future.add_done_callback(cancel_others)

    codes: dict[int, int] = {}
    output_error: OSError | None = None
    try:
        submit()
        while submitted:
            place, future = submitted[0]
            number = study.numbers[place]
            with suppress(CancelledError):
                codes[number], error = _shown(future, f"{study.config} run {number}")
                if error is not None and output_error is None:
                    output_error = error
                    abandon_output()
                    cancel()
            submitted.popleft()
            submit()
    except KeyboardInterrupt:  # the third one
        cancel()
    complete = len(codes) == len(left) and not any(codes.values())
    with suppress(OSError):  # standard error may fail, too
        if output_error is not None and not (complete and isinstance(output_error, BrokenPipeError)):
            print(f"standard output: {output_error.strerror}", file=sys.stderr)
        if not complete:
            _print_unfinished(study, left, codes)
    if output_error is not None:
        return OK if complete and isinstance(output_error, BrokenPipeError) else MISTAKE
    return OK if complete else _exit_code(list(codes.values()), len(left))


_OTHERS_GO_ON = {OK, LOCKED, OVER_MEMORY}
"""Exit codes of runs that do not stop the others."""


def _may_others_go_on(ended: "Future[Reported]") -> bool:
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
    """Wait for a run, print its output, and return the value of `carry_out`."""
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


def checked_duration(text: str | None) -> float | None:
    """Return the time of --stop-after in seconds; None for no limit. Raises ConfigError."""
    from gradysim.scenario.errors import ConfigError
    from gradysim.scenario.parameter_types import quantity

    if text is None:
        return None
    duration_s = float(option_value("--stop-after", text, quantity("s", above=0, at_most=_LONGEST_S)))
    if not hasattr(signal, "setitimer"):
        raise ConfigError(f"--stop-after {text}: this system has no timer that could stop a command")
    return duration_s


def check_jobs(jobs: int) -> None:
    """Raise ConfigError for an invalid number of jobs, before reading files."""
    from gradysim.scenario.errors import ConfigError

    if jobs < 1:
        raise ConfigError(f"--jobs {jobs}: it is out of range; expected 1 or more")
    if jobs > 1 and not hasattr(os, "fork"):
        raise ConfigError(f"--jobs {jobs}: this system cannot fork a process; expected --jobs 1")


_ENDED = {INTERRUPTED: "was interrupted", LOCKED: "was left out"}


def _print_unfinished(study: "Study", left: Sequence[int], codes: Mapping[int, int]) -> None:
    """Print to standard error which of several runs are missing; `codes` are those of the started runs."""
    if len(left) > 1:
        numbers = [study.numbers[place] for place in left]
        done = [number for number in numbers if codes.get(number) == OK]
        missing = [number for number in numbers if number not in codes]
        ended = {number: _ENDED.get(code, "failed") for number, code in sorted(codes.items()) if code != OK}
        print(text_of_unfinished(study.config, done, ended, missing), file=sys.stderr)


def text_of_unfinished(
    config: str, done: Sequence[int], ended: Mapping[int, str], left: Sequence[int]
) -> str:
    """Return which runs of `config` are done, which `ended` otherwise, and which are `left`.

    Numbers are in increasing order. `ended` is "failed" or "was interrupted".
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
