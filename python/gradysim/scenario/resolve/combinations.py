"""Combinations of the values of iteration variables, numbered from 0, and the option `constraint`."""

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import overload

from gradysim.scenario.errors import BadValue, ConfigError, nearest
from gradysim.scenario.parse.expressions import parse_value
from gradysim.scenario.parse.functions import is_quoted, text_of
from gradysim.scenario.parse.ini import Entry
from gradysim.scenario.resolve.sweep import MAX_VALUES, IterationVariable

_THE_OTHERS = "*"
"""Stands for all other variables in `iteration-nesting-order`."""

_VARIABLE_OF_CONSTRAINT = re.compile(r"\$(?:\{\s*(\w+)\s*\}|(\w+))", re.ASCII)


def in_nesting_order(variables: Sequence[IterationVariable], wanted: Entry | None) -> list[IterationVariable]:
    """Return the variables from the outermost to the innermost; by default in their order.

    Raises ConfigError for an order that names an unknown variable, or one twice.
    """
    by_name = {variable.name: variable for variable in variables}
    named = [name.strip() for name in wanted.text.strip('"').split(",") if name.strip()] if wanted else []
    for index, name in enumerate(named):
        if wanted and name in named[:index]:
            raise ConfigError.at(wanted.source, f"`{name}` stands there twice; expected each once")
        if wanted and name != _THE_OTHERS and name not in by_name:
            raise ConfigError.at(
                wanted.source,
                f"there is no variable `{name}`",
                expected=f"some of {', '.join(by_name)}, {_THE_OTHERS} for the others",
                suggestion=nearest(name, by_name),
            )
    if _THE_OTHERS not in named:
        named.append(_THE_OTHERS)
    others = [name for name in by_name if name not in named]
    at = named.index(_THE_OTHERS)
    return [by_name[name] for name in [*named[:at], *others, *named[at + 1 :]]]


class Combinations(Sequence[dict[str, str]]):
    """All combinations of values by name; the last variable changes fastest. They are made one by one."""

    def __init__(self, variables: Sequence[IterationVariable]) -> None:
        """Take variables in nesting order. Their number of combinations and lock-steps must be valid."""
        by_name = {variable.name: variable for variable in variables}
        leaders = {variable.name: _leader(variable, by_name) for variable in variables}
        self._count = 1
        strides: dict[str, int] = {}
        for variable in reversed(variables):
            if not variable.follows:
                strides[variable.name] = self._count
                self._count *= len(variable.values)
        self._digits = {
            name: (strides[leader.name], len(leader.values), by_name[name].values)
            for name, leader in leaders.items()
        }

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int) -> dict[str, str]: ...

    @overload
    def __getitem__(self, index: slice) -> "list[dict[str, str]]": ...

    def __getitem__(self, index: int | slice) -> "dict[str, str] | list[dict[str, str]]":
        if isinstance(index, slice):
            return [self[each] for each in range(self._count)[index]]
        index = range(self._count)[index]
        return {name: values[index // stride % size] for name, (stride, size, values) in self._digits.items()}

    def strides(self, names: Iterable[str]) -> list[tuple[int, int]]:
        """Return (stride, size) for variables with several values: the index of a value in its variable is
        `index // stride % size`, where `index` is that of the combination. Those in lock-step are one.
        """
        found = {(stride, size) for name in names for stride, size, _ in [self._digits[name]] if size > 1}
        return sorted(found)


def count_combinations(variables: Sequence[IterationVariable]) -> int:
    """Return the number of combinations, without making them. ConfigError if there are too many."""
    count = 1
    for variable in variables:
        count *= 1 if variable.follows else len(variable.values)
        if count > MAX_VALUES:
            problem = f"more than {MAX_VALUES} combinations of values; expected fewer"
            raise ConfigError.at(variable.source, problem)
    return count


def check_lock_step(variables: Sequence[IterationVariable]) -> None:
    """Raise ConfigError for a lock-step in a circle, or of a variable with too few values.

    As in OMNeT++, values that its partner does not reach are not used.
    """
    by_name = {variable.name: variable for variable in variables}
    for variable in variables:
        leader = _leader(variable, by_name)
        if len(variable.values) < len(leader.values):
            raise ConfigError.at(
                variable.source,
                f"it has {len(variable.values)} values and is in lock-step with `{leader.name}`, which has"
                f" {len(leader.values)}; expected at least as many",
            )


def _leader(variable: IterationVariable, by_name: Mapping[str, IterationVariable]) -> IterationVariable:
    """Return the variable that this one is finally in lock-step with; itself if there is none."""
    passed = [variable.name]
    while variable.follows:
        if variable.follows in passed:
            raise ConfigError.at(
                variable.source, f"`{variable.follows}` is in lock-step with itself; expected no circle"
            )
        variable = by_name[variable.follows]
        passed.append(variable.name)
    return variable


class Constraint:
    """The option `constraint`: which combinations are runs, as in `$nodes * $rate < 500`.

    It is an expression that is true or false. Variables are written `$x` or `${x}`, and are replaced by their
    values. Each result is cached, since repetitions need it again.
    """

    def __init__(self, entry: Entry) -> None:
        self.source = entry.source
        text = entry.text
        if is_quoted(text):
            text = text[1:-1].replace('\\"', '"')
        self._text = text.strip()
        self._known: dict[str, bool] = {"": True}  # that is the default

    def holds(self, variables: Mapping[str, str]) -> bool:
        """Return whether a combination of values is a run.

        Raises:
            ConfigError: The constraint is neither true nor false, or cannot be decided.
        """

        def value(match: re.Match[str]) -> str:
            name = match[1] or match[2]
            if name in variables:
                return variables[name]
            known = " or ".join(f"`${other}`" for other in variables) or "a configuration with `${x=1, 2}`"
            raise ConfigError.at(self.source, f"there is no variable `{name}`; expected {known}")

        text = _VARIABLE_OF_CONSTRAINT.sub(value, self._text)
        if text not in self._known:
            self._known[text] = self._decide(text)
        return self._known[text]

    def _decide(self, text: str) -> bool:
        try:
            value = parse_value(text)
            if isinstance(value, bool):
                return value
            raise BadValue(f"`{text_of(value)}` is neither true nor false")
        except BadValue as error:
            error = error.with_problem(f"{error.problem} in `{text}`")
            raise error.at(self.source, expected="comparisons such as `$x < $y && $y != 3`") from error
