"""The option `constraint`: which combinations of iteration variables are runs, as in `$nodes * $rate < 500`.

It is an expression (value/expression.py) that is true or false. Variables are written `$x` or `${x}`, and
their texts take their places.
"""

import re
from collections.abc import Mapping
from functools import lru_cache

from gradysim.config.errors.config_error import BadValue, ConfigError
from gradysim.config.file.reader import Entry
from gradysim.config.value.expression import parse_value
from gradysim.config.value.operators import text_of
from gradysim.config.value.quoted import QUOTED

_ONE_TEXT = re.compile(QUOTED, re.DOTALL)
_VARIABLE = re.compile(r"\$(?:\{\s*(\w+)\s*\}|(\w+))", re.ASCII)


def holds(constraint: Entry, variables: Mapping[str, str]) -> bool:
    """Whether a combination of values is wanted.

    Raises:
        ConfigError: The constraint is neither true nor false, or cannot be decided.
    """

    def value_of(match: re.Match[str]) -> str:
        name = match[1] or match[2]
        if name not in variables:
            known = " or ".join(f"`${other}`" for other in variables) or "a configuration with `${x=1, 2}`"
            raise ConfigError.at(constraint.source, f"there is no variable `{name}`; expected {known}")
        return variables[name]

    text = constraint.text
    if _ONE_TEXT.fullmatch(text):
        text = text[1:-1].replace('\\"', '"')
    if not text.strip():  # the default
        return True
    text = _VARIABLE.sub(value_of, text)
    try:
        return _truth_of(text)
    except BadValue as error:
        raise ConfigError.at(
            constraint.source,
            f"{error.problem} in `{text}`; expected comparisons such as `$x < $y && $y != 3`"
            f"{error.suggestion}",
        ) from error


@lru_cache  # for the repetitions of a combination
def _truth_of(text: str) -> bool:
    value = parse_value(text)
    if isinstance(value, bool):
        return value
    raise BadValue(f"`{text_of(value)}` is neither true nor false")
