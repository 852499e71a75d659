"""Seeds of runs: where they come from, and which there are."""

from collections.abc import Mapping
from operator import index

from gradysim.scenario.errors.argument_names import OF_SCRIPT
from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.file.reader import Entry
from gradysim.scenario.options import LARGEST_SEED, OPTIONS
from gradysim.scenario.runs.variables import substitute
from gradysim.scenario.settings import read_scalar


def whole_seed(seed: object) -> int:
    """Return a seed as an int: numpy's integers overflow, and other numbers would be drawn.

    Raises TypeError for what is no whole number.
    """
    try:
        return index(seed)  # type: ignore[arg-type]
    except TypeError:
        raise TypeError(f"seed = {seed!r}: expected a whole number") from None


def checked_seed(seed: object) -> int:
    """Return the seed of a run as an int. Raises TypeError and ValueError for what is none."""
    whole = whole_seed(seed)
    if not 0 <= whole <= LARGEST_SEED:
        raise ValueError(f"seed = {whole}: it is out of range; expected 0 to {LARGEST_SEED}")
    return whole


def check_seeds_of_runs(seed: int, last_run: int, name: str = OF_SCRIPT.seed) -> None:
    """Raise ConfigError unless `seed`, that of run 0, and those of all runs to the last are seeds.

    `name` is what the message begins with.
    """
    if not 0 <= seed <= LARGEST_SEED:
        raise ConfigError(f"{name} {seed}: it is out of range; expected 0 to {LARGEST_SEED}")
    if seed + last_run > LARGEST_SEED:
        raise ConfigError(
            f"{name} {seed}: run {last_run} would have the seed {seed + last_run}; expected at most"
            f" {LARGEST_SEED - last_run}, since run N adds N"
        )


def seed_of_file(options: Mapping[str, Entry], run_number: int, variables: Mapping[str, str]) -> int:
    """Return what the file says, by default the number of the run.

    Raises ConfigError for what is no seed, and for one that depends on itself.
    """
    seed = options.get("seed-set")
    return int(read_scalar(substitute(seed, variables), OPTIONS["seed-set"])) if seed else run_number
