"""`gradysim status`: which runs of a configuration have a result in a directory."""

from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from gradysim.cli.earlier_results import State, states_of
from gradysim.cli.errors import INCOMPLETE, OK, report_error
from gradysim.cli.options import DEFAULT_DIR, FileArgument, ResultDir, RunOptions, StatusOptions
from gradysim.cli.runs import check
from gradysim.cli.study import check_directory
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.resolve.runs import text_of_files, text_of_runs

DEFAULTS = StatusOptions()


def print_status(
    file: FileArgument,
    earlier: Annotated[Path | None, Parameter(name="INI", show=False)] = None,
    /,
    *,
    result_dir: ResultDir = DEFAULT_DIR,
    options: StatusOptions = DEFAULTS,
) -> int:
    """Carry out `gradysim status`, and return the exit code."""
    # `status DIR FILE` is an earlier spelling.
    file, directory = (file, result_dir) if earlier is None else (earlier, file)
    found: dict[tuple[State, tuple[str, ...]], list[int]] = defaultdict(list)
    try:
        check_directory(directory)
        study = check(file, options.config, options.runs, options.settings, options.seed)
        for number, state, changed in states_of(study, _as_of_resume(directory, options)):
            found[state, changed].append(number)
    except (ConfigError, OSError) as error:
        return report_error(error)
    done = found.get((State.DONE, ()), [])
    if options.missing:
        if left := sorted(set(study.numbers).difference(done)):
            print(text_of_runs(left))
    else:
        print(f"{study.config}: {len(done)} of {len(study)} runs are done in {directory}")
        keys = sorted(found, key=lambda key: (list(State).index(key[0]), key[1]))
        rows = {_label(*key): found[key] for key in keys}
        width, digits = max(map(len, rows)), len(str(len(study)))
        for label, numbers in rows.items():
            print(f"{label:{width}}  {len(numbers):{digits}}  {text_of_runs(numbers)}")
    return OK if len(done) == len(study) else INCOMPLETE


def _label(state: State, changed: Sequence[str]) -> str:
    return f"older than {text_of_files(changed)}" if changed else state.value


def _as_of_resume(directory: Path, options: StatusOptions) -> RunOptions:
    """Return the options of `gradysim run --resume` with the same runs."""
    return RunOptions(
        config=options.config,
        runs=options.runs,
        mode=options.mode,
        settings=options.settings,
        seed=options.seed,
        result_dir=directory,
        resume=True,
    )
