"""What a protocol has to achieve, as a condition on quantities of the run."""

import operator
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Self

from gradysim.scenario.errors import ConfigError

_RELATIONS: Mapping[str, Callable[[float, float], bool]] = {
    "<=": operator.le,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    ">": operator.gt,
}
_COMPARISON = re.compile(r"\s*([^<>=!]+?)\s*(<=|>=|==|!=|<|>)\s*([^<>=!]+?)\s*")
_FACTOR = re.compile(r"([-+.\deE]+)\s*\*\s*(\S.*)", re.ASCII)


@dataclass(frozen=True)
class Term:
    """A number, or a quantity with a factor.

    Attributes:
        factor: The number.
        quantity: Name of the quantity, as `gradysim means` prints it; "" for the number alone.
    """

    factor: float
    quantity: str = ""

    @classmethod
    def parse(cls, text: str) -> Self:
        """Read `100`, `uavs[*] sent` or `0.95 * uavs[*] sent`. Raises ValueError for a wrong factor."""
        if factor := _FACTOR.fullmatch(text):
            return cls(float(factor[1]), factor[2])
        try:
            return cls(float(text))
        except ValueError:
            return cls(1.0, text)

    def value(self, numbers: Mapping[str, float]) -> float:
        """Return its value in a run. A quantity that the run does not have counts as 0."""
        return self.factor * numbers.get(self.quantity, 0.0) if self.quantity else self.factor


@dataclass(frozen=True)
class Comparison:
    """`TERM RELATION TERM`.

    Attributes:
        left: The first term.
        relation: One of <, <=, >, >=, ==, !=.
        right: The second term.
    """

    left: Term
    relation: str
    right: Term

    def holds(self, numbers: Mapping[str, float]) -> bool:
        """Return whether the numbers of a run satisfy it."""
        return _RELATIONS[self.relation](self.left.value(numbers), self.right.value(numbers))


@dataclass(frozen=True)
class Assertion:
    """Comparisons joined by `and` and `or`. As in Python, `and` binds more tightly.

    Attributes:
        text: As the user wrote it.
        alternatives: One of them has to hold. Each is a tuple of comparisons that all have to hold.
    """

    text: str
    alternatives: tuple[tuple[Comparison, ...], ...]

    @classmethod
    def parse(cls, text: str) -> Self:
        """Read `base heard >= 100 and base heard >= 0.95 * uavs[*] sent`. Raises ConfigError."""
        alternatives = [
            tuple(_comparison(each, text) for each in re.split(r"\band\b", part))
            for part in re.split(r"\bor\b", text)
        ]
        return cls(text.strip(), tuple(alternatives))

    @property
    def quantities(self) -> tuple[str, ...]:
        """Names of the quantities in it."""
        return tuple(dict.fromkeys(term.quantity for term in self._terms() if term.quantity))

    def holds(self, numbers: Mapping[str, float]) -> bool:
        """Return whether the numbers of a run satisfy it: {quantity: its value}."""
        return any(all(each.holds(numbers) for each in part) for part in self.alternatives)

    def _terms(self) -> Iterator[Term]:
        for part in self.alternatives:
            for each in part:
                yield from (each.left, each.right)


def _comparison(text: str, whole: str) -> Comparison:
    match = _COMPARISON.fullmatch(text)
    try:
        if match is not None:
            found = Comparison(Term.parse(match[1]), match[2], Term.parse(match[3]))
            if found.left.quantity or found.right.quantity:
                return found
    except ValueError:
        pass
    raise ConfigError(
        f"`{text.strip()}` is not a comparison in the assertion `{whole}`"
        if text != whole
        else f"`{whole}` is not an assertion",
        expected="QUANTITY >= NUMBER, such as `groundStation heard >= 100`, or two quantities, such as"
        " `base heard >= 0.95 * uavs[*] sent`; `and` and `or` join several",
    )
