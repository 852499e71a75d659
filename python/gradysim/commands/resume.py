"""What is left of many runs for --resume."""

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

from gradysim.commands.arguments import Mode
from gradysim.commands.asked import Asked
from gradysim.commands.simulators import ids_of_fates
from gradysim.commands.written_files import are_there

if TYPE_CHECKING:
    from gradysim.config.scenario import Scenario


def left_to_do(scenarios: "Sequence[Scenario]", mode: Mode, asked: Asked) -> "list[Scenario]":
    """Return the runs that lack a file that is asked for, and say which do not, and which are outdated.

    Raises ConfigError without a folder.
    """
    from gradysim.config.errors.config_error import ConfigError
    from gradysim.config.runs.file_hashes import text_of_files
    from gradysim.config.runs.run_numbers import text_of_runs
    from gradysim.results.run_file import files_changed_since

    result_dir = asked.result_dir
    if result_dir is None:
        raise ConfigError(
            "--resume: it goes by the JSON files of --result-dir, which is not given;"
            " expected --result-dir DIR, too"
        )
    left, done = [], []
    outdated: dict[tuple[str, ...], list[int]] = {}
    for scenario in scenarios:
        complete = are_there(scenario, mode, asked)
        changed = files_changed_since(scenario, mode, result_dir, ids_of_fates(scenario, asked))
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
