"""Results of earlier runs in --result-dir: runs that --resume skips, and results that need --replace."""

import sys
from collections.abc import Iterator, Sequence
from enum import Enum
from pathlib import Path

from gradysim.cli.options import RunOptions
from gradysim.cli.output import (
    files_beside_result,
    files_for_omnetpp,
    have_labels,
    ids_of_outcomes,
    nodes_of_vectors,
)
from gradysim.results.files import (
    files_changed_since,
    has_another_number,
    has_other_settings,
    has_written,
    run_file,
)
from gradysim.results.omnetpp_reader import recorded_modules
from gradysim.results.result_dir import result_names
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.load import Study
from gradysim.scenario.resolve.runs import text_of_files, text_of_runs
from gradysim.scenario.scenario import Scenario


def runs_to_do(study: Study, options: RunOptions) -> Sequence[int]:
    """Return the positions in `study` of the runs to execute: all, or with --resume those that lack a file.

    Prints which runs are left out, outdated, or to be replaced. Raises ConfigError for results of other
    settings or seeds without --replace, and for --resume without a directory.
    """
    if options.resume:
        return _left_to_do(study, options)
    if options.is_writer:
        found = _with_result(study, options)
        others = [index for index in found if _has_other_settings(study[index], options)]
        _check_others(study, others, options)
    return range(len(study))


def _check_others(study: Study, others: Sequence[int], options: RunOptions) -> None:
    """Raise ConfigError for results of other settings, or print that they will be replaced.

    `others` are the positions of their runs.
    """
    if not others:
        return
    numbers = [study.numbers[index] for index in others]
    which = f"{len(numbers)} of {len(study)} runs ({text_of_runs(numbers)})"
    if not options.replace:
        hint = (
            "; another `repeat` or list of values has changed the numbers of runs; to let `repeat` grow,"
            " begin a study with `iteration-nesting-order = repetition, *`"
        )
        is_renumbered = has_another_number(study[others[0]], options.mode, options.directory)
        raise ConfigError(
            f"--result-dir {options.directory}: it has results with other settings or seeds for {which}",
            expected="another directory; --replace replaces them",
            hint=hint if is_renumbered else "",
        )
    print(
        f"{study.config}: --replace: {options.directory} has results with other settings or seeds for"
        f" {which}; each is kept until its run is complete",
        file=sys.stderr,
    )


def is_of_other_settings(scenario: Scenario, options: RunOptions) -> bool:
    """Return whether a run would replace a result of other settings or another seed without --replace."""
    return options.is_writer and not options.replace and _has_other_settings(scenario, options)


def _has_other_settings(scenario: Scenario, options: RunOptions) -> bool:
    return has_other_settings(scenario, options.mode, options.directory)


def _left_to_do(study: Study, options: RunOptions) -> list[int]:
    """Return the positions of runs that lack a requested file, for --resume."""
    result_dir = options.result_dir
    if result_dir is None:
        raise ConfigError(
            "--resume: it goes by the JSON files of --result-dir, which is not given;"
            " expected --result-dir DIR, too"
        )
    left, done, others = [], [], []
    outdated: dict[tuple[str, ...], list[int]] = {}
    for index, (number, state, changed) in enumerate(states_of(study, options)):
        if state is State.DONE:
            done.append(number)
            continue
        left.append(index)
        if changed:
            outdated.setdefault(changed, []).append(number)
        if state is State.OF_OTHER_SETTINGS:
            others.append(index)
    _check_others(study, others, options)
    for files, runs in outdated.items():
        print(
            f"{study.config}: {text_of_files(files)} changed after {len(runs)} of {len(study)}"
            f" runs in {result_dir} ({text_of_runs(runs)}), which start again",
            file=sys.stderr,
        )
    if done:
        print(
            f"{study.config}: {len(done)} of {len(study)} runs {'is' if len(done) == 1 else 'are'}"
            f" in {result_dir} ({text_of_runs(done)}) and left out",
            file=sys.stderr,
        )
    return left


class State(Enum):
    """What the directory has of a run. The value is the label in `gradysim status`."""

    DONE = "done"
    MISSING = "missing"
    INCOMPLETE = "failed or interrupted"
    OF_OTHER_SETTINGS = "of other settings"
    OF_OTHER_FILES = "of other files"
    WITHOUT_OUTPUT = "without requested files"


def states_of(study: Study, options: RunOptions) -> Iterator[tuple[int, State, tuple[str, ...]]]:
    """Yield the number of each run, its state, and the files that have changed since, as --resume does."""
    with_result = set(_with_result(study, options))
    for index, number in enumerate(study.numbers):
        if index not in with_result:
            yield number, State.MISSING, ()
        else:
            yield number, *_state_of(study[index], options)


def _state_of(scenario: Scenario, options: RunOptions) -> tuple[State, tuple[str, ...]]:
    """Return the state of a run that has a result, and the files that have changed since."""
    if is_done(scenario, options):
        return State.DONE, ()
    changed = files_changed_since(
        scenario, options.mode, options.directory, ids_of_outcomes(scenario, options)
    )
    if changed:
        return State.OF_OTHER_FILES, changed
    if changed is not None:
        return State.WITHOUT_OUTPUT, ()
    if _has_other_settings(scenario, options):
        return State.OF_OTHER_SETTINGS, ()
    return State.INCOMPLETE, ()


def _with_result(study: Study, options: RunOptions) -> list[int]:
    """Return the positions in `study` of runs that have a result in the directory or in its packs."""
    names = result_names(options.directory)
    return [
        index
        for index, number in enumerate(study.numbers)
        if run_file(Path(), study.config, number, options.mode).name in names
    ]


def is_done(scenario: Scenario, options: RunOptions) -> bool:
    """Return whether the directory has an up-to-date result of the run, with all requested files."""
    changed = files_changed_since(
        scenario, options.mode, options.directory, ids_of_outcomes(scenario, options)
    )
    return changed == () and _has_left_its_files(scenario, options)


def _has_left_its_files(scenario: Scenario, options: RunOptions) -> bool:
    """Return whether all requested files other than the result are unchanged, with the current labels."""
    files = files_for_omnetpp(scenario, options)
    return (
        has_written(scenario, options.mode, options.directory, files_beside_result(scenario, options))
        and have_labels(files, scenario, options.mode)
        and _has_vectors(files, scenario, options)
    )


def _has_vectors(files: Sequence[Path], scenario: Scenario, options: RunOptions) -> bool:
    """Return whether the last file has vectors of all requested nodes."""
    expected = {f"{scenario.network}.{node.name}.mobility" for node in nodes_of_vectors(scenario, options)}
    return not expected or expected <= recorded_modules(files[-1])
