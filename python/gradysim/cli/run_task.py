"""The task of a run: it is locked, executed, written and printed. Each has a process of its own."""

import gc
import os
import shutil
import sys
from bisect import bisect_left
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, ExitStack, chdir, nullcontext, redirect_stdout
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import gradysim.results.omnetpp  # noqa: F401 (before processes are forked)
from gradysim.cli.earlier_results import is_done, is_of_other_settings
from gradysim.cli.errors import INTERRUPTED, LOCKED, MISTAKE, OK, OVER_MEMORY, report_error
from gradysim.cli.fork_executor import keep_from_forks
from gradysim.cli.interrupt import StopOnInterrupt
from gradysim.cli.memory import checked_limit
from gradysim.cli.options import RunOptions
from gradysim.cli.output import check_outputs, files_under_way, remove_files_under_way, write_files
from gradysim.cli.runs import check, print_warnings
from gradysim.cli.single_run import execute, report, simulator
from gradysim.execution.run_lock import RunLockedError, run_locked
from gradysim.integrated.compiled_part import CompiledPartMissingError, load_netsim
from gradysim.results.files import run_file
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.resolve.runs import text_of_runs
from gradysim.scenario.resolve.sweep import text_of_iterations

if TYPE_CHECKING:
    from rich.console import Console

    from gradysim.cli.single_run import Run
    from gradysim.scenario.load import Study
    from gradysim.scenario.scenario import Scenario

Reported = tuple[int, OSError | None]
"""The exit code of a run, and the error if standard output takes no more."""


@dataclass(frozen=True)
class Command:
    """What the runs of a command have in common, for processes that know nothing else.

    Attributes:
        file: The .ini file.
        options: Options of the command.
        first: Number of the run whose lint findings are printed.
        line_widths: Widths of the number and of the values in the line about a run. None to print its full
            summary.
        directory: Working directory of the command.
        columns: Width of its terminal; None without one.
        id: Identifies the command.
    """

    file: Path
    options: RunOptions
    first: int
    line_widths: tuple[int, int] | None
    directory: str
    columns: int | None
    id: str

    @staticmethod
    def of(file: Path, options: RunOptions, study: "Study", first: int) -> "Command":
        """Return the command that this process executes, whose first run has the number `first`."""
        has_lines = len(study) > 1 and not options.details
        widths = (len(str(study.numbers[-1])), study.width_of_iterations()) if has_lines else None
        has_width = "COLUMNS" in os.environ or sys.stdout.isatty()
        columns = shutil.get_terminal_size().columns if has_width else None
        return Command(file, options, first, widths, os.getcwd(), columns, os.urandom(8).hex())

    def line_of(self, scenario: "Scenario") -> str | None:
        """Return the beginning of the line about a run; None to print its full summary."""
        if self.line_widths is None:
            return None
        number, width = self.line_widths
        values = f"{text_of_iterations(scenario.iterations)} #{scenario.repetition}".lstrip()
        return f"{scenario.config} run {scenario.run_number:{number}}  {values:{width}}"


@dataclass(frozen=True)
class RunTask:
    """Executes runs of a study, each in a forked process, and reports their results.

    Attributes:
        command: What the runs have in common.
        study: The runs.
        build: Builds a run, ready to execute.
        interrupt: Ctrl-C, and other signals.
        terminal: Terminal for a progress bar.
    """

    command: Command
    study: "Study"
    build: "Callable[[Scenario], Run]"
    interrupt: StopOnInterrupt
    terminal: "Console | None" = None

    @staticmethod
    def of(command: Command, numbers: Sequence[int], interrupt: StopOnInterrupt) -> "RunTask":
        """Return the task of the runs of these numbers, read from the file. Raises ConfigError."""
        options = replace(command.options, runs=text_of_runs(numbers), share=None)
        study = check(command.file, options.config, options.runs, options.settings, options.seed)
        _, build = simulator(options)
        import_what_runs_use(options)
        return RunTask(replace(command, options=options), study, build, interrupt)

    def __call__(self, number: int) -> Reported:
        """Execute the run of this number, write its files, and print its results."""
        gc.enable()
        command, options = self.command, self.command.options
        name = f"{self.study.config} run {number}"
        memory_bytes = checked_limit(options.memory)
        try:
            with ExitStack() as at_end:
                with self.interrupt.at_once():  # while it waits for a command that packs
                    at_end.enter_context(self._lock(number))
                with redirect_stdout(sys.stderr) if options.as_json else nullcontext(), chdir("."):
                    scenario = self.study[bisect_left(self.study.numbers, number)]
                    check_outputs(scenario, options)
                    done = f"{name}: another process has done it"
                    if options.resume and is_done(scenario, options):
                        print(f"{done}; left out", file=sys.stderr)
                        return OK, None
                    if is_of_other_settings(scenario, options):
                        print(f"{done} with other settings; left out", file=sys.stderr)
                        return MISTAKE, None
                    at_end.callback(remove_files_under_way, scenario, options)
                    if hasattr(os, "fork"):
                        keep_from_forks(files_under_way(scenario, options))
                    outcome = execute(self.build, scenario, self.interrupt, self.terminal, memory_bytes)
                if number == command.first:
                    print_warnings(outcome.findings)
                write = partial(write_files, scenario, options=options)
                code, output_error = report(outcome, write, options, command.line_of(scenario))
        except RunLockedError as locked:
            print(f"{name}: {locked}; left out", file=sys.stderr)
            return LOCKED, None
        except KeyboardInterrupt:  # while it waited or was built
            return INTERRUPTED, None
        except (ConfigError, CompiledPartMissingError, OSError) as error:
            return report_error(error), None
        if memory_bytes is not None and isinstance(outcome.failure, MemoryError):
            print(f"{name}: it needs more than --memory {options.memory}", file=sys.stderr)
            return OVER_MEMORY, output_error
        return code, output_error

    def _lock(self, number: int) -> AbstractContextManager[None]:
        """Return the lock of a run, if it writes files. Its `with` statement raises RunLockedError."""
        options = self.command.options
        if not options.is_writer:
            return nullcontext()
        return run_locked(options.directory, run_file(Path(), self.study.config, number, options.mode).name)


def import_what_runs_use(options: RunOptions) -> None:
    """Import what each run would import after its fork otherwise. Raises CompiledPartMissingError."""
    if options.mode == "integrated":
        load_netsim()
    if not (options.as_json or options.quiet):
        import gradysim.cli.summary  # noqa: F401
