"""The option `constraint`: which combinations of iteration variables are runs, as in `$nodes * $rate < 500`.

Its grammar: comparisons of two values, joined by `&&` and `||`, of which `&&` binds more tightly. Variables
are written `$x` or `${x}`.
"""

import operator
import re
from collections.abc import Callable, Mapping
from typing import Any

from gradysim.config.errors.config_error import BadValue, ConfigError
from gradysim.config.file.reader import Entry
from gradysim.config.value.expression import Value, parse_value
from gradysim.config.value.quantity import Quantity

_COMPARISONS: dict[str, Callable[[Any, Any], bool]] = {
    "<=": operator.le,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    ">": operator.gt,
}
_SIGN = re.compile(r"(<=|>=|==|!=|<|>)")
_TEXT = re.compile(r'"(?:[^"\\]|\\.)*"')
_VARIABLE = re.compile(r"\$(?:\{\s*(\w+)\s*\}|(\w+))", re.ASCII)


def holds(constraint: Entry, variables: Mapping[str, str]) -> bool:
    """Whether a combination of values is wanted.

    Raises:
        ConfigError: The constraint is no comparison, or cannot be decided.
    """

    def value_of(match: re.Match[str]) -> str:
        name = match[1] or match[2]
        if name not in variables:
            known = " or ".join(f"`${other}`" for other in variables) or "a configuration with `${x=1, 2}`"
            raise ConfigError.at(constraint.source, f"there is no variable `{name}`; expected {known}")
        return variables[name]

    text = constraint.text
    if text.startswith('"') and text.endswith('"'):
        text = text[1:-1].replace('\\"', '"')
    if not text.strip():  # the default
        return True
    text = _VARIABLE.sub(value_of, text)
    try:
        return any(all(map(_comparison, alternative.split("&&"))) for alternative in text.split("||"))
    except BadValue as error:
        raise ConfigError.at(
            constraint.source,
            f"{error.problem} in `{text}`; expected comparisons such as `$x < $y && $y != 3`"
            f"{error.suggestion}",
        ) from error


def _comparison(text: str) -> bool:
    parts = _SIGN.split(text)
    if not text.strip():
        raise BadValue("a comparison is missing")
    if len(parts) != 3:
        raise BadValue(f"`{text.strip()}` is not one comparison", _hint(text))
    bare = [_TEXT.sub("", side) for side in parts]
    if any(side.count("(") != side.count(")") for side in bare):
        raise BadValue("a comparison stands in parentheses, which go around values only")
    left, right = parse_value(parts[0]), parse_value(parts[2])
    return _COMPARISONS[parts[1]](*_comparable(left, right))


def _hint(text: str) -> str:
    """How other languages write what was meant."""
    if match := re.search(r"\b(and|or)\b", text):
        return f"; did you mean `{'&&' if match[1] == 'and' else '||'}`?"
    return "; did you mean `==`?" if re.search(r"(?<![<>=!])=(?!=)", text) else ""


def _comparable(left: Value, right: Value) -> tuple[object, object]:
    """Both as Python's numbers or texts. Raises BadValue if they are of different kinds."""
    if isinstance(left, Quantity) and isinstance(right, Quantity):
        if left.unit is None and right.unit is None:
            return left.number, right.number
        if left.unit is not None and right.unit is not None:
            return left.to(right.unit), float(right.number)
        raise BadValue(f"`{left}` and `{right}` measure different things")
    if type(left) is type(right) and isinstance(left, str | bool):
        return left, right
    raise BadValue("it compares a number with something else")
