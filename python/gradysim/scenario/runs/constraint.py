"""The option `constraint`: which combinations of iteration variables are runs, as in `$nodes * $rate < 500`.

It is an expression (value/expression.py) that is true or false. Variables are written `$x` or `${x}`, and
their texts take their places.
"""

import re
from collections.abc import Mapping

from gradysim.scenario.errors.config_error import BadValue, ConfigError
from gradysim.scenario.expressions import parse_value
from gradysim.scenario.file.reader import Entry
from gradysim.scenario.functions import is_quoted, text_of

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
            raise ConfigError.at(
                self.source,
                f"{error.problem} in `{text}`; expected comparisons such as `$x < $y && $y != 3`"
                f"{error.suggestion}",
            ) from error
