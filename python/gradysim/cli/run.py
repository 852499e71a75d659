"""`gradysim run`: checks the runs of a configuration, carries them out, and says what came out."""

import sys
from collections.abc import Sequence
from contextlib import chdir, nullcontext, redirect_stdout
from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING

from gradysim.cli.arguments import ConfigOption, FileArgument, SetOption
from gradysim.cli.asked import Asked
from gradysim.cli.exit_code import INTERRUPTED, OK, say_mistake
from gradysim.cli.result_dir import (
    check_file_names,
    check_may_be_written_to,
    check_sqlite,
    make_result_dir,
)
from gradysim.cli.resume import left_to_do
from gradysim.cli.run_options import (
    FatesAtOption,
    JobsOption,
    JsonOption,
    ModeOption,
    PcapOption,
    QuietOption,
    ResultDirOption,
    ResumeOption,
    RunsOption,
    ScalarsOption,
    SeedOption,
    VectorsOption,
)
from gradysim.cli.scenarios import check, placed
from gradysim.cli.simulators import check_names, simulator
from gradysim.cli.study import check_jobs, run_all
from gradysim.cli.warnings import findings_of, tell, warnings_of_seeds
from gradysim.cli.written_files import write_files

if TYPE_CHECKING:
    from rich.console import Console

    from gradysim.scenario.scenario import Scenario


def run(
    file: FileArgument,
    /,
    *,
    config: ConfigOption = "General",
    runs: RunsOption = None,
    mode: ModeOption = "integrated",
    settings: SetOption = (),
    seed: SeedOption = None,
    result_dir: ResultDirOption = None,
    resume: ResumeOption = False,
    jobs: JobsOption = 1,
    scalars: ScalarsOption = False,
    vectors: VectorsOption = (),
    pcap: PcapOption = (),
    fates_at: FatesAtOption = (),
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> int:
    """Run the runs of a configuration and say what came out."""
    from gradysim.cli.crash_report import report_crashes
    from gradysim.cli.execution import execute, report
    from gradysim.cli.interrupt import StopOnInterrupt
    from gradysim.cli.runner import ForkExecutor
    from gradysim.cli.waiting import waiting
    from gradysim.integrated.compiled_part import CompiledPartMissingError
    from gradysim.scenario.errors.config_error import ConfigError

    asked = Asked(result_dir, pcap, fates_at, scalars, vectors)
    bar = not quiet and not as_json
    try:
        check_jobs(jobs)
        check_sqlite(asked)
        if asked.writes_files:
            make_result_dir(asked.directory)
        # What protocols print when they are imported must not get between the JSON objects.
        with redirect_stdout(sys.stderr) if as_json else nullcontext():
            with waiting(f"reading {file}", shown=bar):
                checked = check(file, config, runs, settings, seed)
            scenarios: Sequence[Scenario] = checked.scenarios
            check_network, build = simulator(mode, asked)
            check_names(scenarios, asked)
            check_file_names(scenarios, mode, asked)
            tell(warnings_of_seeds(scenarios))
            if resume:
                scenarios = left_to_do(scenarios, mode, asked)
                if not scenarios:
                    return OK
            if asked.writes_files:
                check_may_be_written_to(asked.directory)
            with waiting(f"reading {file}", shown=bar):
                scenarios = placed(checked, scenarios)
            with waiting(f"checking {config}", shown=bar):
                for scenario in scenarios:
                    check_network(scenario, is_built_next=len(scenarios) == 1)
            tell(findings_of(scenarios, mode))
    except (ConfigError, CompiledPartMissingError, OSError) as mistake:
        return say_mistake(mistake)

    def carry_out(scenario: "Scenario") -> tuple[int, OSError | None]:
        try:
            with redirect_stdout(sys.stderr) if as_json else nullcontext(), chdir("."):
                outcome = execute(build, scenario, interrupt, terminal)
            if scenario is scenarios[0]:
                tell(outcome.findings)
            write = partial(write_files, scenario, asked=asked)
            return report(outcome, write, as_json=as_json, quiet=quiet)
        except KeyboardInterrupt:  # while it was built
            return INTERRUPTED, None
        except (ConfigError, CompiledPartMissingError, OSError) as mistake:
            return say_mistake(mistake), None

    report_crashes()
    terminal = error_terminal() if bar and jobs == 1 else None
    import_what_runs_use(asked, summaries=not (as_json or quiet))
    with StopOnInterrupt() as interrupt:
        return run_all(scenarios, carry_out, ForkExecutor(jobs, interrupt))


def error_terminal() -> "Console | None":
    """Return the terminal that shows a progress bar, if the error output is one."""
    if not sys.stderr.isatty():
        return None
    from rich.console import Console

    import gradysim.cli.progress  # noqa: F401 (before processes are forked)

    return Console(stderr=True)


def import_what_runs_use(asked: Asked, *, summaries: bool) -> None:
    """Import the modules that report a run before a process is forked for each run."""
    names = ["rich._emoji_codes", "gradysim.cli.console", "gradysim.cli.summary"] if summaries else []
    if asked.writes_files:
        names.append("gradysim.results.files")
    if asked.scalars or asked.vectors:
        names.append("gradysim.results.omnetpp")
    for name in names:
        import_module(name)
