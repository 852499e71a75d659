"""What is left of many runs for --resume."""

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.cli.options import Mode, RunOptions
from gradysim.cli.output import files_beside_result, files_for_omnetpp, ids_of_fates, nodes_of_vectors

if TYPE_CHECKING:
    from gradysim.scenario.scenario import Scenario


def left_to_do(scenarios: "Sequence[Scenario]", options: RunOptions) -> "list[Scenario]":
    """Return the runs that lack a file that is asked for, and say which do not, and which are outdated.

    Raises ConfigError without a folder.
    """
    from gradysim.results.files import files_changed_since
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
    for scenario in scenarios:
        complete = _has_left_its_files(scenario, options)
        changed = files_changed_since(scenario, options.mode, result_dir, ids_of_fates(scenario, options))
        if changed == () and complete:
            done.append(scenario.run_number)
            continue
        left.append(scenario)
        if changed:
            outdated.setdefault(changed, []).append(scenario.run_number)
    for files, runs in outdated.items():
        print(
            f"{scenarios[0].config}: {text_of_files(files)} changed after {len(runs)} of {len(scenarios)}"
            f" runs in {result_dir} ({text_of_runs(runs)}), which begin anew",
            file=sys.stderr,
        )
    if done:
        print(
            f"{scenarios[0].config}: {len(done)} of {len(scenarios)} runs {'is' if len(done) == 1 else 'are'}"
            f" in {result_dir} ({text_of_runs(done)}) and left out",
            file=sys.stderr,
        )
    return left


def _has_left_its_files(scenario: "Scenario", options: RunOptions) -> bool:
    """Whether all that is asked for beside its result is there as the run left it, with the labels of now."""
    from gradysim.results.files import has_written

    files = files_for_omnetpp(scenario, options)
    return (
        has_written(scenario, options.mode, options.directory, files_beside_result(scenario, options))
        and _have_labels(files, scenario, options.mode)
        and _has_vectors(files, scenario, options)
    )


def _have_labels(files: Sequence[Path], scenario: "Scenario", mode: Mode) -> bool:
    """Whether files for OMNeT++ are those of one run, with the attributes that it has now."""
    from gradysim.results.omnetpp import lasting_attributes, storable
    from gradysim.results.omnetpp_reader import run_attributes

    expected = {name: storable(text) for name, text in lasting_attributes(scenario, mode).items()}
    found = [run_attributes(file) for file in files]
    return all(
        expected.items() <= attributes.items() and attributes["runID"] == found[0]["runID"]
        for attributes in found
    )


def _has_vectors(files: Sequence[Path], scenario: "Scenario", options: RunOptions) -> bool:
    """Whether the last of the files has vectors of all nodes that are asked for."""
    from gradysim.results.omnetpp_reader import recorded_modules

    expected = {f"{scenario.network}.{node.name}.mobility" for node in nodes_of_vectors(scenario, options)}
    return not expected or expected <= recorded_modules(files[-1])
