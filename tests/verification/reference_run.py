"""Runs the scenarios of configs/reference in integrated mode, with changes."""

from collections.abc import Iterable
from pathlib import Path

import gradysim.integrated.run
from gradysim.config import Scenario, load_scenarios
from gradysim.results.run_result import RunResult

FOLDER = Path(__file__).parents[2] / "configs" / "reference"


def load_reference(
    name: str, config: str = "General", *, run: int = 0, seed: int = 0, overrides: Iterable[str] = ()
) -> Scenario:
    """One run of configs/reference/NAME.ini; `overrides` are lines that come before those of the file."""
    file = FOLDER / f"{name}.ini"
    return load_scenarios(file, config, runs=[run], overrides=[*overrides, f"seed-set={seed}"])[0]


def run_reference(
    name: str, config: str = "General", *, run: int = 0, seed: int = 0, overrides: Iterable[str] = ()
) -> RunResult:
    """The result of `load_reference` with the same arguments."""
    return gradysim.integrated.run.run(load_reference(name, config, run=run, seed=seed, overrides=overrides))


def tracked(result: RunResult, variable: str, group: str = "") -> list[int]:
    """The variable of each node that tracks it, of one group or of all."""
    return [
        int(str(node.tracked_variables[variable]))
        for node in result.nodes
        if variable in node.tracked_variables and node.name.startswith(group)
    ]


def received_in_error(result: RunResult) -> int:
    """Broadcast frames that a radio had locked on and then lost."""
    fates = result.fates["frames"]["broadcast"]
    return fates["noise"] + fates["interference"]
