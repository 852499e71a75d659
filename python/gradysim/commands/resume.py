"""What is left of many runs for --resume."""

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.commands.arguments import Mode
from gradysim.commands.simulators import captures, files_written, ids_of_fates

if TYPE_CHECKING:
    from gradysim.config.scenario import Scenario


def left_to_do(
    scenarios: "Sequence[Scenario]",
    mode: Mode,
    result_dir: Path | None,
    fates_at: Sequence[str],
    pcap: Sequence[str],
) -> "list[Scenario]":
    """Return the runs that lack a result or a capture, and say which do not, and whose result is outdated.

    Raises ConfigError without a folder, and for names in `fates_at` and `pcap` that are none of nodes.
    """
    from gradysim.config.errors.config_error import ConfigError
    from gradysim.config.runs.file_hashes import text_of_files
    from gradysim.config.runs.run_numbers import text_of_runs
    from gradysim.results.run_file import files_changed_since

    if result_dir is None:
        raise ConfigError("--resume: there is no folder to look into; expected --result-dir DIR, too")
    left, done = [], []
    outdated: dict[tuple[str, ...], list[int]] = {}
    for scenario in scenarios:
        captured = all(
            file.is_file() for file in files_written(scenario, captures(scenario, pcap, result_dir))
        )
        changed = files_changed_since(scenario, mode, result_dir, ids_of_fates(scenario, fates_at))
        if changed == () and captured:
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
