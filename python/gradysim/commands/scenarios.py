"""The scenarios that a command line names."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gradysim.config.scenario import Scenario


def load(
    file: Path, config: str, runs: str | None, settings: Sequence[str], seed: int | None = None
) -> "list[Scenario]":
    """Return one scenario per run. Raises ConfigError."""
    from gradysim.config.error import ConfigError
    from gradysim.config.keys.options import LARGEST_SEED
    from gradysim.config.scenario import load_scenarios

    scenarios = load_scenarios(file, config, runs, settings)
    if seed is None:
        return scenarios
    if not 0 <= seed <= LARGEST_SEED:
        raise ConfigError(f"--seed {seed}: it is out of range; expected 0 to {LARGEST_SEED}")
    last = max(scenario.run_number for scenario in scenarios)
    if seed + last > LARGEST_SEED:
        raise ConfigError(
            f"--seed {seed}: run {last} would have the seed {seed + last}; expected at most"
            f" {LARGEST_SEED - last}, since run N adds N"
        )
    return [replace(scenario, seed=seed + scenario.run_number) for scenario in scenarios]
