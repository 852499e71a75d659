"""`gradysim.run`: one run in this process, or the runs of a study in processes of their own."""

import shutil
import weakref
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory, mkdtemp

from gradysim.cli.errors import OK
from gradysim.cli.options import RunOptions
from gradysim.cli.run import run_study
from gradysim.cli.runs import findings_of, print_warnings
from gradysim.replay.sink import ReplayWriter
from gradysim.results import Runs, runs
from gradysim.results.result import Mode, RunResult
from gradysim.scenario.load import Study
from gradysim.scenario.resolve.runs import text_of_runs
from gradysim.scenario.scenario import Scenario, check_node_names, nodes_named
from gradysim.scripting.progress import progress_bar
from gradysim.stepping import check_mode, start

_OF_SIGNALS = 128
"""Exit codes after Ctrl-C, SIGTERM and SIGHUP are larger."""


class StudyError(RuntimeError):
    """Runs of a study failed. Their tracebacks are on standard error.

    Attributes:
        exit_code: That of `gradysim run`.
        missing: Numbers of the runs without a result.
    """

    def __init__(self, text: str, exit_code: int, missing: tuple[int, ...]) -> None:
        super().__init__(text, exit_code, missing)  # all, so that it can be pickled
        self.exit_code = exit_code
        self.missing = missing

    def __str__(self) -> str:
        return str(self.args[0])


def run_scenario(scenario: Scenario, mode: Mode, replay: Iterable[str], *, progress: bool) -> RunResult:
    """Execute a run in this process and return its result. Exceptions of protocols are raised."""
    title = f"{scenario.config} run {scenario.run_number}"
    if not replay:
        return _executed(scenario, mode, None, title, progress=progress)
    check_node_names([scenario], replay, "replay", 1)
    recorded = {node.id for node in nodes_named(scenario, replay)}
    is_all = len(recorded) == len(scenario.nodes)
    with TemporaryDirectory(prefix="gradysim-") as folder:
        page = Path(folder) / "replay.html"
        sink = ReplayWriter(page, None if is_all else recorded)
        result = _executed(scenario, mode, sink, title, progress=progress)
        return replace(result, replay_page=page.read_text(encoding="utf-8"))


def _executed(
    scenario: Scenario, mode: Mode, sink: ReplayWriter | None, title: str, *, progress: bool
) -> RunResult:
    made = start(scenario, mode, replay=sink)
    if not progress:
        made.execute()
        return made.result()
    limit_s = scenario.sim_time_limit_s
    with progress_bar(title, "s") as update:
        update(0, limit_s)
        made.execute(lambda time_s: update(time_s, limit_s))
        update(limit_s, limit_s)
    return made.result()


def run_file(
    study: Study,
    file: Path,
    *,
    mode: Mode,
    jobs: int,
    result_dir: Path | None,
    resume: bool,
    replay: tuple[str, ...],
    progress: bool,
) -> RunResult | Runs:
    """Execute the runs of a study; see `gradysim.run` for arguments, results and exceptions."""
    check_mode(mode)
    if len(study) == 1 and result_dir is None:
        print_warnings(findings_of([study[0]], mode))
        return run_scenario(study[0], mode, replay, progress=progress)
    directory = Path(mkdtemp(prefix="gradysim-")) if result_dir is None else result_dir
    options = RunOptions(
        config=study.config,
        mode=mode,
        jobs=jobs,
        result_dir=directory,
        resume=resume,
        replay=replay,
        quiet=True,
    )
    try:
        found = _run_study(study, file, options, progress=progress)
    except BaseException:
        if result_dir is None:
            shutil.rmtree(directory, ignore_errors=True)
        raise
    if result_dir is None:
        weakref.finalize(found, shutil.rmtree, directory, ignore_errors=True)
    return found


def _run_study(study: Study, file: Path, options: RunOptions, *, progress: bool) -> Runs:
    if progress:
        with progress_bar(study.config, "runs") as update:
            code = run_study(study, file, options, update)
    else:
        code = run_study(study, file, options, lambda done, total: None)
    if code > _OF_SIGNALS:
        raise KeyboardInterrupt
    wanted = set(study.numbers)
    found = Runs(
        run
        for run in runs(options.directory)
        if run.config == study.config and run.mode == options.mode and run.run in wanted
    )
    missing = tuple(sorted(wanted - {run.run for run in found}))
    if code != OK or missing:
        which = f"runs {text_of_runs(missing)} have no result" if missing else "some runs were left out"
        raise StudyError(f"{study.config}: {which}; standard error says why", code, missing)
    return found
