"""`gradysim run`: checks the runs of a configuration, carries them out, and says what came out."""

import sys
from collections.abc import Sequence
from contextlib import chdir, nullcontext, redirect_stdout
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.cli.exit_code import INTERRUPTED, OK, say_mistake
from gradysim.cli.options import FileArgument, RunOptions
from gradysim.cli.output import (
    check_file_names,
    check_may_be_written_to,
    check_sqlite,
    make_result_dir,
    write_files,
)
from gradysim.cli.resume import left_to_do
from gradysim.cli.runs import check, placed
from gradysim.cli.warnings import findings_of, tell, warnings_of_seeds

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from rich.console import Console

    from gradysim.scenario.scenario import Scenario


DEFAULTS = RunOptions()


def run(file: FileArgument, /, *, options: RunOptions = DEFAULTS) -> int:
    """Run the runs of a configuration and say what came out."""
    return run_file(file, options)


def run_file(file: Path, options: RunOptions, executor: "Executor | None" = None) -> int:
    """Do what `gradysim run` does, and return its exit code.

    Args:
        file: The .ini file.
        options: Those of the command.
        executor: Carries out the runs, each in a process of its own by default. What `submit` gets cannot be
            pickled.
    """
    from gradysim.cli.crash_report import report_crashes
    from gradysim.cli.execution import check_names, execute, report, simulator
    from gradysim.cli.interrupt import StopOnInterrupt
    from gradysim.cli.runner import ForkExecutor
    from gradysim.cli.study import check_jobs, run_all
    from gradysim.cli.waiting import waiting
    from gradysim.integrated.compiled_part import CompiledPartMissingError
    from gradysim.scenario.errors import ConfigError, ErrorCollector

    bar = not options.quiet and not options.as_json
    try:
        check_jobs(options.jobs)
        check_sqlite(options)
        if options.writes_files:
            make_result_dir(options.directory)
        # What protocols print when they are imported must not get between the JSON objects.
        with redirect_stdout(sys.stderr) if options.as_json else nullcontext():
            with waiting(f"reading {file}", shown=bar):
                checked = check(file, options.config, options.runs, options.settings, options.seed)
            scenarios: Sequence[Scenario] = checked.scenarios
            check_network, build = simulator(options)
            check_names(scenarios, options)
            check_file_names(scenarios, options)
            tell(warnings_of_seeds(scenarios))
            if options.resume:
                scenarios = left_to_do(scenarios, options)
                if not scenarios:
                    return OK
            if options.writes_files:
                check_may_be_written_to(options.directory)
            with waiting(f"reading {file}", shown=bar):
                scenarios = placed(checked, scenarios)
            with waiting(f"checking {options.config}", shown=bar):
                errors = ErrorCollector()
                for scenario in scenarios:
                    with errors.collecting():
                        check_network(scenario, is_built_next=len(scenarios) == 1)
                errors.raise_all()
            tell(findings_of(scenarios, options.mode))
    except (ConfigError, CompiledPartMissingError, OSError) as mistake:
        return say_mistake(mistake)

    def carry_out(scenario: "Scenario") -> tuple[int, OSError | None]:
        try:
            with redirect_stdout(sys.stderr) if options.as_json else nullcontext(), chdir("."):
                outcome = execute(build, scenario, interrupt, terminal)
            if scenario is scenarios[0]:
                tell(outcome.findings)
            write = partial(write_files, scenario, options=options)
            return report(outcome, write, as_json=options.as_json, quiet=options.quiet)
        except KeyboardInterrupt:  # while it was built
            return INTERRUPTED, None
        except (ConfigError, CompiledPartMissingError, OSError) as mistake:
            return say_mistake(mistake), None

    report_crashes()
    terminal = error_terminal() if bar and options.jobs == 1 else None
    import_what_runs_use(options)
    with StopOnInterrupt() as interrupt:
        return run_all(scenarios, carry_out, executor or ForkExecutor(options.jobs, interrupt))


def error_terminal() -> "Console | None":
    """Return the terminal that shows a progress bar, if the error output is one."""
    if not sys.stderr.isatty():
        return None
    from rich.console import Console

    import gradysim.cli.progress  # noqa: F401 (before processes are forked)

    return Console(stderr=True)


def import_what_runs_use(options: RunOptions) -> None:
    """Import the modules that report a run before a process is forked for each run."""
    names = []
    if not (options.as_json or options.quiet):
        names += ["rich._emoji_codes", "gradysim.cli.console", "gradysim.cli.summary"]
    if options.writes_files:
        names.append("gradysim.results.files")
    if options.scalars or options.vectors:
        names.append("gradysim.results.omnetpp")
    for name in names:
        import_module(name)
