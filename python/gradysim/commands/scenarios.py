"""The scenarios that a command line names."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.commands.current_folder import back_afterwards

if TYPE_CHECKING:
    from gradysim.config.scenario import Scenario


def load(
    file: Path, config: str, runs: str | None, settings: Sequence[str], seed: int | None = None
) -> "list[Scenario]":
    """Return one scenario per run. Raises ConfigError."""
    from gradysim.config.errors.argument_names import ArgumentNames
    from gradysim.config.scenario import load_scenarios

    names = ArgumentNames(overrides="--set", seed="--seed", runs="-r", config="-c")
    with back_afterwards():  # files of protocols are carried out
        return load_scenarios(file, config, runs, settings, seed, names=names)
