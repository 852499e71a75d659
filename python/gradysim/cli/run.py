"""`gradysim run`: checks the runs of a configuration, carries them out, and says what came out."""

import contextlib
import sys
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, TextIO

from gradysim.cli.arguments import ConfigOption, FileArgument, SetOption
from gradysim.cli.asked import Asked
from gradysim.cli.current_folder import back_afterwards
from gradysim.cli.exit_code import OK, say_mistake
from gradysim.cli.one_run import report, run_one
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
from gradysim.cli.several_runs import check_jobs, one_after_the_other, several_at_once
from gradysim.cli.simulators import check_names, simulator
from gradysim.cli.warnings import findings_of, tell, warnings_of_seeds
from gradysim.cli.written_files import write_files

if TYPE_CHECKING:
    from gradysim.cli.interrupt import StopOnInterrupt
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
    from gradysim.cli.waiting import waiting
    from gradysim.integrated.compiled_part import CompiledPartMissingError
    from gradysim.scenario.errors.config_error import ConfigError

    asked = Asked(result_dir, pcap, fates_at, scalars, vectors)
    output = sys.stdout
    bar = not quiet and not as_json
    # What protocols print, also when they are imported, must not get between the JSON objects.
    with contextlib.redirect_stdout(sys.stderr) if as_json else contextlib.nullcontext():
        try:
            check_jobs(jobs)
            check_sqlite(asked)
            if asked.writes_files:
                make_result_dir(asked.directory)
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

            def carry_out(scenario: "Scenario", interrupt: "StopOnInterrupt", output: TextIO) -> int:
                with back_afterwards():
                    outcome = run_one(build, scenario, interrupt, bar=bar)
                if scenario is scenarios[0]:
                    tell(outcome.findings)
                write = partial(write_files, scenario, asked=asked)
                return report(outcome, output, write, as_json=as_json, quiet=quiet)

            if jobs == 1:
                return one_after_the_other(scenarios, carry_out, output)
            return several_at_once(scenarios, carry_out, output, jobs)
        except (ConfigError, CompiledPartMissingError, OSError) as mistake:
            return say_mistake(mistake)
