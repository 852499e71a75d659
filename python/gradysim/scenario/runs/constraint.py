"""The option `constraint`: which combinations of iteration variables are runs, as in `$nodes * $rate < 500`.

It is an expression (value/expression.py) that is true or false. Variables are written `$x` or `${x}`, and
their texts take their places.
"""

import re
from collections.abc import Mapping

from gradysim.scenario.errors import BadValue, ConfigError
from gradysim.scenario.ini import Entry
from gradysim.scenario.value.expression import parse_value
from gradysim.scenario.value.operators import text_of
from gradysim.scenario.value.quoted import is_quoted

_VARIABLE = re.compile(r"\$(?:\{\s*(\w+)\s*\}|(\w+))", re.ASCII)


class Constraint:
    """One constraint. What it says of equal values is worked out once: repetitions ask for it again."""

    def __init__(self, entry: Entry) -> None:
        self.source = entry.source
        text = entry.text
        if is_quoted(text):
            text = text[1:-1].replace('\\"', '"')
        self._text = text.strip()
        self._known: dict[str, bool] = {"": True}  # that is the default

    def holds(self, variables: Mapping[str, str]) -> bool:
        """Whether a combination of values is wanted.

        Raises:
            ConfigError: The constraint is neither true nor false, or cannot be decided.
        """
        text = _VARIABLE.sub(lambda match: self._value(match[1] or match[2], variables), self._text)
        if text not in self._known:
            self._known[text] = self._decide(text)
        return self._known[text]

    def _value(self, name: str, variables: Mapping[str, str]) -> str:
        if name not in variables:
            known = " or ".join(f"`${other}`" for other in variables) or "a configuration with `${x=1, 2}`"
            raise ConfigError.at(self.source, f"there is no variable `{name}`; expected {known}")
        return variables[name]

    def _decide(self, text: str) -> bool:
        try:
            value = parse_value(text)
            if isinstance(value, bool):
                return value
            raise BadValue(f"`{text_of(value)}` is neither true nor false")
        except BadValue as error:
            expected = "comparisons such as `$x < $y && $y != 3`"
            problem = error.with_problem(f"{error.problem} in `{text}`")
            raise problem.at(self.source, expected=expected) from error
