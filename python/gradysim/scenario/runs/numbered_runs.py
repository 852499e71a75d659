"""The runs of a configuration: all combinations of values that a constraint leaves, each repeated.

Repetitions are values of one more iteration variable, `repetition`, the innermost one unless
`iteration-nesting-order` says otherwise.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice
from typing import NamedTuple

from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.errors.nearest import did_you_mean
from gradysim.scenario.errors.source import Source
from gradysim.scenario.file.reader import Entry
from gradysim.scenario.options import OPTIONS
from gradysim.scenario.runs.constraint import Constraint
from gradysim.scenario.runs.iterations import (
    MAX_VALUES,
    REPETITION,
    IterationVariable,
    check_lock_step,
    combinations,
    count_combinations,
)
from gradysim.scenario.runs.run_numbers import select_runs
from gradysim.scenario.settings import read_scalar

_THE_OTHERS = "*"


class NumberedRun(NamedTuple):
    """One run: its number, its repetition, and the values of the iteration variables by name."""

    number: int
    repetition: int
    iterations: dict[str, str]


def numbered_runs(
    options: Mapping[str, Entry],
    variables: Sequence[IterationVariable],
    config: str,
    runs: str | Iterable[int] | None,
    source: Source,
    name: str,
) -> tuple[list[NumberedRun], int]:
    """Return the runs that are wanted, and the number of all.

    `source` is the place of the configuration, and `name` what messages about `runs` begin with. Raises
    ConfigError for what makes no runs, and what `select_runs` raises.
    """
    repetitions = _repetitions(options.get("repeat"), source)
    nested = in_nesting_order([*variables, repetitions], options.get("iteration-nesting-order"))
    check_lock_step(nested)
    repeat, combined = len(repetitions.values), count_combinations(variables)
    count = combined * repeat
    if count > MAX_VALUES:
        raise ConfigError(
            f"configuration `{config}` has {combined} combinations of values and {repeat} runs of each;"
            f" expected at most {MAX_VALUES} runs",
            repetitions.source,
        )
    made_of = f"{combined} combinations of values, `repeat = {repeat}`" if variables else ""
    entry = options.get("constraint")
    constraint = Constraint(entry) if entry else None
    if constraint is not None:
        count = sum(1 for _ in _allowed(nested, constraint))
        made_of = f"what the constraint leaves of {made_of}" if made_of else ""
        if count == 0:
            raise ConfigError.at(
                constraint.source, f"none of {combined} combinations of values is left; expected one at least"
            )
    numbers = select_runs(runs, count, config, repetitions.source, made_of, name)
    wanted = set(numbers)
    every = islice(_allowed(nested, constraint), numbers[-1] + 1 if numbers else 0)
    chosen = [
        NumberedRun(number, int(values.pop(REPETITION)), values)
        for number, values in enumerate(every)
        if number in wanted
    ]
    return chosen, count


def in_nesting_order(variables: Sequence[IterationVariable], wanted: Entry | None) -> list[IterationVariable]:
    """The variables from the outermost to the innermost one.

    By default they are nested in their order, the repetitions innermost. Raises ConfigError for an order that
    names a variable that is not there, or one twice.
    """
    by_name = {variable.name: variable for variable in variables}
    named = [name.strip() for name in wanted.text.strip('"').split(",") if name.strip()] if wanted else []
    for place, name in enumerate(named):
        if wanted and name in named[:place]:
            raise ConfigError.at(wanted.source, f"`{name}` stands there twice; expected each once")
        if wanted and name != _THE_OTHERS and name not in by_name:
            known = ", ".join([*by_name, f"{_THE_OTHERS} for the others"])
            raise ConfigError.at(
                wanted.source,
                f"there is no variable `{name}`; expected some of {known}{did_you_mean(name, by_name)}",
            )
    if _THE_OTHERS not in named:
        named.append(_THE_OTHERS)
    others = [name for name in by_name if name not in named]
    at = named.index(_THE_OTHERS)
    return [by_name[name] for name in [*named[:at], *others, *named[at + 1 :]]]


def _allowed(
    variables: Sequence[IterationVariable], constraint: Constraint | None
) -> Iterator[dict[str, str]]:
    every = combinations(variables)
    return every if constraint is None else filter(constraint.holds, every)


def _repetitions(repeat: Entry | None, source: Source) -> IterationVariable:
    """The variable `repetition`. Raises ConfigError if the option is no number."""
    if repeat is None:
        return IterationVariable(REPETITION, ("0",), source)
    if "${" in repeat.text:
        raise ConfigError.at(repeat.source, "it is the same for all combinations; expected a number")
    count = int(read_scalar(repeat, OPTIONS["repeat"]))
    return IterationVariable(REPETITION, tuple(map(str, range(count))), repeat.source)
