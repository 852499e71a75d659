"""What a protocol has to achieve, as a condition on a quantity of the run."""

import operator
import re
from collections.abc import Callable, Mapping
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
_ASSERTION = re.compile(r"\s*([^<>=!]+?)\s*(<=|>=|==|!=|<|>)\s*([-+.\deE]+)\s*", re.ASCII)


@dataclass(frozen=True)
class Assertion:
    """`QUANTITY RELATION NUMBER`.

    Attributes:
        metric: Name of a quantity, as `gradysim means` prints it.
        relation: One of <, <=, >, >=, ==, !=.
        bound: The number.
    """

    metric: str
    relation: str
    bound: float

    @classmethod
    def parse(cls, text: str) -> Self:
        """Read `groundStation collected >= 100`. Raises ConfigError."""
        match = _ASSERTION.fullmatch(text)
        try:
            if match is not None:
                return cls(match[1], match[2], float(match[3]))
        except ValueError:
            pass
        raise ConfigError(
            f"`{text}` is not an assertion",
            expected="QUANTITY >= NUMBER, such as `groundStation heard >= 100`",
        )

    def holds(self, value: float) -> bool:
        """Return whether a value satisfies it."""
        return _RELATIONS[self.relation](value, self.bound)
