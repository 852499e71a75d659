"""`gradysim run`: checks the runs of a configuration, executes them, and reports their results."""

import gc
import os
import signal
import sys
import time
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from contextlib import ExitStack, nullcontext, redirect_stdout
from pathlib import Path
from typing import NamedTuple

from rich.console import Console

from gradysim.cli.dask_workers import dask_workers
from gradysim.cli.earlier_results import runs_to_do
from gradysim.cli.errors import INTERRUPTED, OK, report_crashes, report_error
from gradysim.cli.executor import RunExecutor, Workers
from gradysim.cli.interrupt import KILLING, StopOnInterrupt
from gradysim.cli.memory import checked_limit
from gradysim.cli.options import FileArgument, RunOptions, option_value
from gradysim.cli.output import (
    check_file_names,
    check_may_be_written_to,
    check_sqlite,
    make_result_dir,
)
from gradysim.cli.progress import waiting
from gradysim.cli.run_all import run_all
from gradysim.cli.run_task import Command, RunTask, import_what_runs_use
from gradysim.cli.runs import check, findings_of, print_warnings, warnings_of_seeds
from gradysim.cli.share import part_of_share
from gradysim.cli.single_run import Run, check_names, simulator
from gradysim.cli.until import Until, checked_until, rounds_of
from gradysim.cli.workers import ExecutorWorkers, ForkedWorkers
from gradysim.encapsulator.run_context import gc_paused
from gradysim.execution.run_lock import remove_left_over_files, remove_lock_file
from gradysim.integrated.compiled_part import CompiledPartMissingError
from gradysim.scenario.errors import ConfigError, ErrorCollector
from gradysim.scenario.load import Study
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.parameter_types import quantity

DEFAULTS = RunOptions()

_LONGEST_S = 366 * 86400
"""Longest time of --stop-after: a year."""


def run(file: FileArgument, /, *, options: RunOptions = DEFAULTS) -> int:
    """Carry out `gradysim run`, and return the exit code."""
    with gc_paused():  # nothing of what is read is garbage
        return run_file(file, options)


class _Prepared(NamedTuple):
    """A study that is checked, and what is left to do.

    Attributes:
        study: The runs.
        left: Indices of the runs to execute.
        until: Condition of --until.
        build: Builds a run, ready to execute.
        command: What its processes need.
    """

    study: Study
    left: Sequence[int]
    until: Until | None
    build: Callable[[Scenario], Run]
    command: Command


def run_file(file: Path, options: RunOptions, executor: Executor | None = None) -> int:
    """Run `gradysim run` and return its exit code.

    Args:
        file: The .ini file.
        options: Options of the command. With an executor, `jobs` is the number of its workers.
        executor: Executes batches of runs; the caller shuts it down. Its workers read the file themselves, so
            they need the same directories and packages. By default each run has a process of this machine.
    """
    begin_s = time.monotonic()
    gc.freeze()  # excludes modules from the open files, which the runner searches
    with ExitStack() as connection:
        try:
            stop_after_s = checked_duration(options.stop_after)
            prepared = _prepare(file, options)
            if prepared is None:
                if options.is_writer:  # a killed command may have left some after its last run
                    remove_left_over_files(options.directory)
                return OK
            workers: Workers | None = None
            if executor is not None:
                workers = ExecutorWorkers(executor, options.jobs, prepared.command)
            elif options.executor == "dask":
                workers = connection.enter_context(dask_workers(prepared.command))
        except (ConfigError, CompiledPartMissingError, OSError) as error:
            return report_error(error)
        left_s = None if stop_after_s is None else stop_after_s - (time.monotonic() - begin_s)
        return _execute(prepared, workers, left_s)


def run_study(study: Study, file: Path, options: RunOptions, on_progress: Callable[[int, int], None]) -> int:
    """Run the runs of a study that was read in this process, for a script, and return the exit code.

    Args:
        study: The runs.
        file: Its .ini file.
        options: Options of the command, without `executor`, `until` and `stop_after`.
        on_progress: Called with the number of runs that have ended, and that of all to do.

    Raises:
        ConfigError, CompiledPartMissingError, OSError: The study or an option is not valid.
    """
    gc.freeze()  # as `run_file`
    try:
        prepared = _prepare(file, options, study)
        return OK if prepared is None else _execute(prepared, on_progress=on_progress)
    finally:
        gc.unfreeze()


def _prepare(file: Path, options: RunOptions, study: Study | None = None) -> _Prepared | None:
    """Read and check the study; None if no run is left. Raises ConfigError and OSError."""
    bar = _has_bar(options)
    check_jobs(options.jobs)
    if options.scheduler is not None and options.executor != "dask":
        raise ConfigError(f"--scheduler {options.scheduler}: expected --executor dask, too")
    checked_limit(options.memory)
    until = checked_until(options)
    check_sqlite(options)
    if options.writes_files:
        make_result_dir(options.directory)
    # Output of protocols at import must not get between the JSON objects.
    with redirect_stdout(sys.stderr) if options.as_json else nullcontext():
        part = part_of_share(options.share)
        with waiting(f"reading {file}", shown=bar):
            if study is None:
                study = check(file, options.config, options.runs, options.settings, options.seed, part)
            if not len(study):
                print(f"{study.config}: --share {options.share} has no run", file=sys.stderr)
                return None
            checked = study.checked_in_full()
        check_network, build = simulator(options)
        check_names(checked, options, len(study))
        check_file_names(study, options)
        print_warnings(warnings_of_seeds(study))
        left = runs_to_do(study, options)
        if not left:
            return None
        if options.writes_files:
            check_may_be_written_to(options.directory)
        with waiting(f"checking {options.config}", shown=bar):
            errors = ErrorCollector()
            for scenario in checked:
                with errors.collecting():
                    check_network(scenario, is_built_next=len(left) == 1)
            errors.raise_all()
        print_warnings(findings_of(checked, options.mode))
    command = Command.of(file, options, study, first=study.numbers[left[0]])
    return _Prepared(study, left, until, build, command)


def _execute(
    prepared: _Prepared,
    workers: Workers | None = None,
    left_s: float | None = None,
    on_progress: Callable[[int, int], None] | None = None,
) -> int:
    """Execute the runs by workers, by default processes of this machine, and return the exit code.

    `left_s` is the wall time in seconds until the command stops; None for no end. Scripts get `on_progress`,
    which is that of `run_study`.
    """
    study, _, _, build, command = prepared
    options = command.options
    report_crashes()
    if options.is_writer and not remove_left_over_files(options.directory):
        print(
            f"{options.directory}: warning: its file system has no locks, so unfinished files of killed"
            " commands stay there",
            file=sys.stderr,
        )
    with StopOnInterrupt(left_s, raises_at=KILLING) as interrupt:
        if workers is None:
            is_alone = _has_bar(options) and options.jobs == 1 and not options.trace
            terminal = error_terminal() if is_alone else None
            import_what_runs_use(options)
            task = RunTask(command, study, build, interrupt, terminal)
            workers = ForkedWorkers(task, options.jobs, interrupt, captures=on_progress is not None)
        with RunExecutor(workers, interrupt) as executor:
            code = _run_rounds(prepared, executor, on_progress)
        if options.is_writer:
            remove_lock_file(options.directory)
    if code == INTERRUPTED:
        code = interrupt.exit_code
    has_lines = command.line_widths is not None
    if code == OK and has_lines and options.is_writer and not (options.as_json or options.quiet):
        print(f"files in {options.directory}")
    return code


def _run_rounds(
    prepared: _Prepared, executor: RunExecutor, on_progress: Callable[[int, int], None] | None
) -> int:
    """Compute the runs that are left, round by round with --until, and return the exit code."""
    study, left, until, _, command = prepared
    try:
        for indices in rounds_of(study, left, until, command.options):
            code = run_all(study.config, [study.numbers[index] for index in indices], executor, on_progress)
            if code != OK:
                return code
    except (ConfigError, OSError) as error:
        return report_error(error)
    return OK


def _has_bar(options: RunOptions) -> bool:
    return not options.quiet and not options.as_json


def error_terminal() -> Console | None:
    """Return the terminal for a progress bar, if standard error is one."""
    if not sys.stderr.isatty():
        return None
    import rich.progress  # noqa: F401 (before processes are forked)

    return Console(stderr=True)


def checked_duration(text: str | None) -> float | None:
    """Return the time of --stop-after in seconds; None for no limit. Raises ConfigError."""
    if text is None:
        return None
    duration_s = float(option_value("--stop-after", text, quantity("s", above=0, at_most=_LONGEST_S)))
    if not hasattr(signal, "setitimer"):
        raise ConfigError(f"--stop-after {text}: this system has no timer that could stop a command")
    return duration_s


def check_jobs(jobs: int) -> None:
    """Raise ConfigError for an invalid number of jobs, before reading files."""
    if jobs < 1:
        raise ConfigError(f"--jobs {jobs}: it is out of range; expected 1 or more")
    if jobs > 1 and not hasattr(os, "fork"):
        raise ConfigError(f"--jobs {jobs}: this system cannot fork a process; expected --jobs 1")
