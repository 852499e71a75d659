"""The task of a run: it is locked, executed, written and printed. Each has a process of its own."""

import gc
import os
import sys
from collections.abc import Callable
from contextlib import AbstractContextManager, ExitStack, chdir, nullcontext, redirect_stdout
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.cli.earlier_results import is_done, is_of_other_settings
from gradysim.cli.errors import INTERRUPTED, LOCKED, MISTAKE, OK, OVER_MEMORY, say_mistake
from gradysim.cli.interrupt import StopOnInterrupt
from gradysim.cli.memory import checked_limit
from gradysim.cli.options import RunOptions
from gradysim.cli.output import check_outputs, files_under_way, remove_files_under_way, write_files
from gradysim.cli.runs import tell

if TYPE_CHECKING:
    from rich.console import Console

    from gradysim.cli.execution import Run
    from gradysim.scenario.load import Study
    from gradysim.scenario.scenario import Scenario

Reported = tuple[int, OSError | None]
"""The exit code of a run, and the error if standard output takes no more."""


@dataclass(frozen=True)
class LineStart:
    """The beginning of the line about a run. All lines of a study have the same widths."""

    number_width: int
    values_width: int

    @staticmethod
    def of(study: "Study") -> "LineStart":
        """Return the widths for these runs."""
        return LineStart(len(str(study.numbers[-1])), study.width_of_iterations())

    def text(self, scenario: "Scenario") -> str:
        """Return the configuration, the number and the values of a run."""
        from gradysim.scenario.sweep import text_of_iterations

        values = f"{text_of_iterations(scenario.iterations)} #{scenario.repetition}".lstrip()
        return (
            f"{scenario.config} run {scenario.run_number:{self.number_width}}  {values:{self.values_width}}"
        )


@dataclass(frozen=True)
class RunTask:
    """Executes the runs of a study, each in a forked process, and reports their results.

    Attributes:
        study: The runs.
        options: Options of the command.
        build: Builds a run, ready to execute.
        interrupt: Ctrl-C, and other signals.
        first: Number of the run whose lint findings are printed.
        line: Beginning of the line about a run; None to print its full summary.
        terminal: Terminal for a progress bar.
    """

    study: "Study"
    options: RunOptions
    build: "Callable[[Scenario], Run]"
    interrupt: StopOnInterrupt
    first: int
    line: LineStart | None
    terminal: "Console | None" = None

    def __call__(self, place: int) -> Reported:
        """Execute the run at a position of the study, write its files, and print its results."""
        from gradysim.cli.execution import execute, report
        from gradysim.cli.runner import keep_from_forks
        from gradysim.execution.run_lock import RunLockedError
        from gradysim.integrated.compiled_part import CompiledPartMissingError
        from gradysim.scenario.errors import ConfigError

        gc.enable()
        options, number = self.options, self.study.numbers[place]
        name = f"{self.study.config} run {number}"
        memory_bytes = checked_limit(options.memory)
        try:
            with ExitStack() as at_end:
                with self.interrupt.at_once():  # while it waits for a command that packs
                    at_end.enter_context(self._lock(number))
                with redirect_stdout(sys.stderr) if options.as_json else nullcontext(), chdir("."):
                    scenario = self.study[place]
                    check_outputs(scenario, options)
                    if options.resume and is_done(scenario, options):
                        print(f"{name}: another process has done it; left out", file=sys.stderr)
                        return OK, None
                    if is_of_other_settings(scenario, options):
                        print(
                            f"{name}: another process has done it with other settings; left out",
                            file=sys.stderr,
                        )
                        return MISTAKE, None
                    at_end.callback(remove_files_under_way, scenario, options)
                    if hasattr(os, "fork"):
                        keep_from_forks(files_under_way(scenario, options))
                    outcome = execute(self.build, scenario, self.interrupt, self.terminal, memory_bytes)
                if number == self.first:
                    tell(outcome.findings)
                write = partial(write_files, scenario, options=options)
                line = None if self.line is None else self.line.text(scenario)
                code, output_error = report(outcome, write, options, line)
        except RunLockedError as locked:
            print(f"{name}: {locked}; left out", file=sys.stderr)
            return LOCKED, None
        except KeyboardInterrupt:  # while it waited or was built
            return INTERRUPTED, None
        except (ConfigError, CompiledPartMissingError, OSError) as mistake:
            return say_mistake(mistake), None
        if memory_bytes is not None and isinstance(outcome.failure, MemoryError):
            print(f"{name}: it needs more than --memory {options.memory}", file=sys.stderr)
            return OVER_MEMORY, output_error
        return code, output_error

    def _lock(self, number: int) -> AbstractContextManager[None]:
        """Return the lock of a run, if it writes files. Its `with` statement raises RunLockedError."""
        from gradysim.execution.run_lock import run_locked
        from gradysim.results.files import run_file

        options = self.options
        if not options.is_writer:
            return nullcontext()
        return run_locked(options.directory, run_file(Path(), self.study.config, number, options.mode).name)


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
