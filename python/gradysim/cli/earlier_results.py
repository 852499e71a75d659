"""Results of earlier runs in --result-dir: what --resume leaves out, and what is not replaced unasked."""

import sys
from collections.abc import Sequence
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
    """Raise ConfigError for results of other settings or seeds that these runs would replace unasked."""
    from gradysim.results.files import run_file
    from gradysim.scenario.errors import ConfigError
    from gradysim.scenario.runs import text_of_runs

    others = []
    for place, number in enumerate(study.numbers if options.is_writer else ()):
        file = run_file(options.directory, study.config, number, options.mode)
        if file.exists() and is_of_other_settings(study[place], options):
            others.append(number)
    if others:
        raise ConfigError(
            f"--result-dir {options.directory}: it has results with other settings or seeds for"
            f" {len(others)} of {len(study)} runs ({text_of_runs(others)})",
            expected="another directory; --replace or --resume replaces them",
        )


def is_of_other_settings(scenario: "Scenario", options: RunOptions) -> bool:
    """Return whether a run would replace a result of other settings or another seed, and unasked."""
    from gradysim.results.files import has_other_settings

    if not options.is_writer or options.resume or options.replace:
        return False
    return has_other_settings(scenario, options.mode, options.directory)


def left_to_do(study: "Study", options: RunOptions) -> list[int]:
    """Return the places in `study` of runs that lack a file that is asked for.

    Says which do not, and which are outdated.

    Raises ConfigError without a folder.
    """
    from gradysim.results.files import files_changed_since, run_file
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
    for place, number in enumerate(study.numbers):
        if not run_file(result_dir, study.config, number, options.mode).exists():
            left.append(place)
            continue
        scenario = study[place]
        if is_done(scenario, options):
            done.append(number)
            continue
        left.append(place)
        if changed := files_changed_since(
            scenario, options.mode, result_dir, ids_of_fates(scenario, options)
        ):
            outdated.setdefault(changed, []).append(number)
    for files, runs in outdated.items():
        print(
            f"{study.config}: {text_of_files(files)} changed after {len(runs)} of {len(study)}"
            f" runs in {result_dir} ({text_of_runs(runs)}), which begin anew",
            file=sys.stderr,
        )
    if done:
        print(
            f"{study.config}: {len(done)} of {len(study)} runs {'is' if len(done) == 1 else 'are'}"
            f" in {result_dir} ({text_of_runs(done)}) and left out",
            file=sys.stderr,
        )
    return left


def is_done(scenario: "Scenario", options: RunOptions) -> bool:
    """Return whether the directory has the result of the run as it is now, with all wanted files."""
    from gradysim.results.files import files_changed_since

    changed = files_changed_since(scenario, options.mode, options.directory, ids_of_fates(scenario, options))
    return changed == () and _has_left_its_files(scenario, options)


def _has_left_its_files(scenario: "Scenario", options: RunOptions) -> bool:
    """Whether all that is asked for beside its result is there as the run left it, with the labels of now."""
    from gradysim.results.files import has_written

    files = files_for_omnetpp(scenario, options)
    return (
        has_written(scenario, options.mode, options.directory, files_beside_result(scenario, options))
        and have_labels(files, scenario, options.mode)
        and _has_vectors(files, scenario, options)
    )


def _has_vectors(files: Sequence[Path], scenario: "Scenario", options: RunOptions) -> bool:
    """Whether the last of the files has vectors of all nodes that are asked for."""
    from gradysim.results.omnetpp_reader import recorded_modules

    expected = {f"{scenario.network}.{node.name}.mobility" for node in nodes_of_vectors(scenario, options)}
    return not expected or expected <= recorded_modules(files[-1])
