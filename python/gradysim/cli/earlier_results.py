"""Results of earlier runs in --result-dir: runs that --resume skips, and results that need --replace."""

import sys
from collections.abc import Iterator, Sequence
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.cli.options import RunOptions
from gradysim.cli.output import (
    files_beside_result,
    files_for_omnetpp,
    have_labels,
    ids_of_fates,
    nodes_of_vectors,
)

if TYPE_CHECKING:
    from gradysim.scenario.load import Study
    from gradysim.scenario.scenario import Scenario


def check_other_settings(study: "Study", options: RunOptions) -> None:
    """Raise ConfigError if these runs would replace results of other settings or seeds without --replace."""
    from gradysim.scenario.errors import ConfigError
    from gradysim.scenario.runs import text_of_runs

    others = [
        study.numbers[place]
        for place in (_with_result(study, options) if options.is_writer else ())
        if is_of_other_settings(study[place], options)
    ]
    if others:
        raise ConfigError(
            f"--result-dir {options.directory}: it has results with other settings or seeds for"
            f" {len(others)} of {len(study)} runs ({text_of_runs(others)})",
            expected="another directory; --replace or --resume replaces them",
        )


def is_of_other_settings(scenario: "Scenario", options: RunOptions) -> bool:
    """Return whether a run would replace a result of other settings or another seed without --replace."""
    from gradysim.results.files import has_other_settings

    if not options.is_writer or options.resume or options.replace:
        return False
    return has_other_settings(scenario, options.mode, options.directory)


def left_to_do(study: "Study", options: RunOptions) -> list[int]:
    """Return the positions in `study` of runs that lack a requested file.

    Prints the other runs, and the outdated ones. Raises ConfigError without a directory.
    """
    from gradysim.scenario.errors import ConfigError
    from gradysim.scenario.runs import text_of_files, text_of_runs

    result_dir = options.result_dir
    if result_dir is None:
        raise ConfigError(
            "--resume: it goes by the JSON files of --result-dir, which is not given;"
            " expected --result-dir DIR, too"
        )
    left, done = [], []
    outdated: dict[tuple[str, ...], list[int]] = {}
    for place, (number, state, changed) in enumerate(states_of(study, options)):
        if state is State.DONE:
            done.append(number)
            continue
        left.append(place)
        if changed:
            outdated.setdefault(changed, []).append(number)
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


def states_of(study: "Study", options: RunOptions) -> Iterator[tuple[int, State, tuple[str, ...]]]:
    """Yield the number of each run, its state, and the files that have changed since, as --resume does."""
    with_result = set(_with_result(study, options))
    for place, number in enumerate(study.numbers):
        if place not in with_result:
            yield number, State.MISSING, ()
        else:
            yield number, *_state_of(study[place], options)


def _state_of(scenario: "Scenario", options: RunOptions) -> tuple[State, tuple[str, ...]]:
    """Return the state of a run that has a result, and the files that have changed since."""
    from gradysim.results.files import files_changed_since, has_other_settings

    if is_done(scenario, options):
        return State.DONE, ()
    changed = files_changed_since(scenario, options.mode, options.directory, ids_of_fates(scenario, options))
    if changed:
        return State.OF_OTHER_FILES, changed
    if changed is not None:
        return State.WITHOUT_OUTPUT, ()
    if has_other_settings(scenario, options.mode, options.directory):
        return State.OF_OTHER_SETTINGS, ()
    return State.INCOMPLETE, ()


def _with_result(study: "Study", options: RunOptions) -> list[int]:
    """Return the positions in `study` of runs that have a result in the directory or in its packs."""
    from gradysim.results.files import run_file
    from gradysim.results.result_dir import result_names

    names = result_names(options.directory)
    return [
        place
        for place, number in enumerate(study.numbers)
        if run_file(Path(), study.config, number, options.mode).name in names
    ]


def is_done(scenario: "Scenario", options: RunOptions) -> bool:
    """Return whether the directory has an up-to-date result of the run, with all requested files."""
    from gradysim.results.files import files_changed_since

    changed = files_changed_since(scenario, options.mode, options.directory, ids_of_fates(scenario, options))
    return changed == () and _has_left_its_files(scenario, options)


def _has_left_its_files(scenario: "Scenario", options: RunOptions) -> bool:
    """Return whether all requested files other than the result are unchanged, with the current labels."""
    from gradysim.results.files import has_written

    files = files_for_omnetpp(scenario, options)
    return (
        has_written(scenario, options.mode, options.directory, files_beside_result(scenario, options))
        and have_labels(files, scenario, options.mode)
        and _has_vectors(files, scenario, options)
    )


def _has_vectors(files: Sequence[Path], scenario: "Scenario", options: RunOptions) -> bool:
    """Return whether the last file has vectors of all requested nodes."""
    from gradysim.results.omnetpp_reader import recorded_modules

    expected = {f"{scenario.network}.{node.name}.mobility" for node in nodes_of_vectors(scenario, options)}
    return not expected or expected <= recorded_modules(files[-1])
