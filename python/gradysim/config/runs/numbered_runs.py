"""The runs of a configuration: all combinations of values that a constraint leaves, each repeated."""

from collections.abc import Iterable, Mapping, Sequence

from gradysim.config.errors.config_error import ConfigError
from gradysim.config.errors.source import Source
from gradysim.config.file.reader import Entry
from gradysim.config.keys.options import OPTIONS
from gradysim.config.runs.constraint import holds
from gradysim.config.runs.iterations import MAX_VALUES, IterationVariable, combinations, count_combinations
from gradysim.config.runs.run_numbers import select_runs
from gradysim.config.value.setting import read_scalar


def numbered_runs(
    options: Mapping[str, Entry],
    variables: list[IterationVariable],
    config: str,
    runs: str | Iterable[int] | None,
    source: Source,
    name: str,
) -> tuple[list[tuple[int, int, dict[str, str]]], int]:
    """Return the runs that are wanted, (number, repetition, values of variables), and the number of all.

    `source` is the place of the configuration, and `name` what messages about `runs` begin with. Raises
    ConfigError for what makes no runs, and what `select_runs` raises.
    """
    repeat = options.get("repeat")
    if repeat is not None and "${" in repeat.text:
        raise ConfigError.at(repeat.source, "it is the same for all combinations; expected a number")
    repetitions = int(read_scalar(repeat, OPTIONS["repeat"])) if repeat else 1
    count = count_combinations(variables)
    chosen: Sequence[dict[str, str]] | None = None
    if (constraint := options.get("constraint")) is not None:
        chosen = [values for values in combinations(variables) if holds(constraint, values)]
        if not chosen:
            raise ConfigError.at(
                constraint.source, f"none of {count} combinations of values is left; expected one at least"
            )
        count = len(chosen)
    if count * repetitions > MAX_VALUES:
        raise ConfigError(
            f"configuration `{config}` has {count} combinations of values and {repetitions} runs of each;"
            f" expected at most {MAX_VALUES} runs",
            repeat.source if repeat else source,
        )
    made_of = f"{count} combinations of values, `repeat = {repetitions}`" if variables else ""
    place = repeat.source if repeat else source
    numbers = select_runs(runs, count * repetitions, config, place, made_of, name)
    if chosen is None:
        chosen = list(combinations(variables))
    wanted = [(number, number % repetitions, chosen[number // repetitions]) for number in numbers]
    return wanted, count * repetitions
