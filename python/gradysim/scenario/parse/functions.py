"""Values, and the operators and functions of expressions on them: `$a < $b`, `max(1s, 200ms)`, `int(7 / 2)`.

Names, meanings and precedence are OMNeT++'s. Functions that draw random numbers are in `distributions`, those
that know the parameter that a value is for are in `expressions`.
"""

import math
import operator
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from gradysim.scenario.errors import BadValue
from gradysim.scenario.parse.patterns import compile_pattern
from gradysim.scenario.parse.units import Number, Quantity, is_finite

Value = Quantity | str | bool

QUOTED = r'"(?:[^"\\]|\\.)*"'
"""Regular expression, for re.DOTALL, of a string in quotes. A backslash escapes the next character."""

_LONGEST_MATCHED = 10_000
"""Characters of a string that `=~` compares with a pattern. The time grows with both lengths."""

_ONE_STRING = re.compile(QUOTED, re.DOTALL)
_ESCAPED = re.compile(r"\\(.)", re.DOTALL)
_ESCAPES = {"n": "\n", "t": "\t", "r": "\r"}


def is_quoted(written: str) -> bool:
    """Whether a value is one string in quotes. An expression of strings, `"a" + "b"`, is not."""
    return _ONE_STRING.fullmatch(written) is not None


def unquoted(written: str) -> str:
    """Return the string that stands in quotes."""
    return _ESCAPED.sub(lambda match: _ESCAPES.get(match[1], match[1]), written[1:-1])


def text_of(value: Value | tuple[Any, ...]) -> str:
    """Return a value, or a list of values, as it is written in a file."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, tuple):
        return f"[{', '.join(map(text_of, value))}]"
    return f'"{value}"' if isinstance(value, str) else str(value)


def truth(value: Value, sign: str) -> bool:
    """Return an operand of the logical operator `sign`. BadValue if it is not true or false."""
    if not isinstance(value, bool):
        raise BadValue(f"`{sign}` is for true and false, and `{text_of(value)}` is neither")
    return value


def number(value: Value) -> Quantity:
    """Return an operand of arithmetic. BadValue if it is not a number."""
    if not isinstance(value, Quantity):
        raise BadValue(f"arithmetic is for numbers only, and `{text_of(value)}` is not a number")
    return value


@dataclass(frozen=True)
class Operator:
    """An operator with two operands.

    Attributes:
        level: The operator with the higher level binds more tightly; of one level, the left one.
        apply: The result for the left and the right operand. Raises BadValue.
        decided_by: The truth of the left operand that is the result, whatever the right one is.
    """

    level: int
    apply: Callable[[Value, Value], Value]
    decided_by: bool | None = None


def _sum(left: Value, right: Value) -> Value:
    if isinstance(left, str) and isinstance(right, str):
        return left + right
    return number(left).plus(number(right))


def _comparison(compare: Callable[[Any, Any], bool]) -> Callable[[Value, Value], Value]:
    """Compare two numbers in any units, two strings by their characters, or two truth values."""

    def apply(left: Value, right: Value) -> Value:
        if isinstance(left, Quantity) and isinstance(right, Quantity):
            return compare(*left.numbers_beside(right))
        if type(left) is type(right):
            return compare(left, right)
        hint = "; several comparisons are joined by `&&`" if isinstance(left, bool) else ""
        raise BadValue(f"`{text_of(left)}` and `{text_of(right)}` cannot be compared", hint)

    return apply


def _matches(left: Value, right: Value) -> Value:
    if isinstance(left, str) and isinstance(right, str):
        if len(left) > _LONGEST_MATCHED:
            raise BadValue(f"`=~` is for strings of at most {_LONGEST_MATCHED} characters, not {len(left)}")
        return compile_pattern(right).matches(left)
    raise BadValue("`=~` is for a string and a pattern, both in quotes")


OPERATORS: dict[str, Operator] = {
    "||": Operator(0, lambda _, right: truth(right, "||"), decided_by=True),
    "&&": Operator(1, lambda _, right: truth(right, "&&"), decided_by=False),
    "==": Operator(2, _comparison(operator.eq)),
    "!=": Operator(2, _comparison(operator.ne)),
    "<": Operator(3, _comparison(operator.lt)),
    "<=": Operator(3, _comparison(operator.le)),
    ">": Operator(3, _comparison(operator.gt)),
    ">=": Operator(3, _comparison(operator.ge)),
    "=~": Operator(4, _matches),
    "+": Operator(5, _sum),
    "-": Operator(5, lambda left, right: number(left).plus(number(right), -1)),
    "*": Operator(6, lambda left, right: number(left).times(number(right))),
    "/": Operator(6, lambda left, right: number(left).over(number(right))),
    "%": Operator(6, lambda left, right: number(left).modulo(number(right))),
}
"""Operators by sign. `^`, which alone takes its right operand first, is part of the grammar."""


def check_count(written: str, count: int) -> None:
    """Raise BadValue unless the function written as `written`, `pow(x, y)`, takes that many values."""
    takes = written.count(",") + (not written.endswith("()"))
    if count != takes:
        raise BadValue(f"`{written}` takes {takes} value{'' if takes == 1 else 's'}, not {count}")


def call(name: str, values: Sequence[Value]) -> Value:
    """Return the result of one of FUNCTIONS. BadValue if it takes other values."""
    written, apply = FUNCTIONS[name]
    check_count(written, len(values))
    try:
        return apply(*values)
    except BadValue as error:
        raise error.with_problem(f"`{name}`: {error.problem}") from None


def integer(value: Value) -> int:
    """Return a plain number written without a point. BadValue if the value is another one."""
    if isinstance(value, Quantity) and value.unit is None and isinstance(value.number, int):
        return value.number
    raise BadValue(f"`{text_of(value)}` is not an integer")


def item_index(index: Value, count: int) -> int:
    """Return the index of one of `count` items. BadValue if there is no such item."""
    item = integer(number(index))
    if not 0 <= item < count:
        raise BadValue(f"there is no item {item}, only 0 to {count - 1}")
    return item


def _of_plain_numbers(function: Callable[..., float]) -> Callable[..., Value]:
    """A function of Python's module math. It is an error where that has no value."""

    def apply(*values: Value) -> Value:
        numbers = [float(_plain(value)) for value in values]
        try:
            return Quantity(function(*numbers))
        except (ValueError, OverflowError):
            listed = ", ".join(f"`{text_of(value)}`" for value in values)
            raise BadValue(f"it has no value for {listed}") from None

    return apply


def _plain(value: Value) -> Number:
    quantity = number(value)
    if quantity.unit is not None:
        raise BadValue(f"`{quantity}` is not a plain number")
    return quantity.number


def _rounded(rounding: Callable[[Number], int]) -> Callable[[Value], Value]:
    """As in OMNeT++ not an integer but a number with a point, which only `int` makes an integer."""

    def apply(value: Value) -> Value:
        exact = _plain(value)
        return Quantity(Fraction(rounding(exact)) if math.isfinite(exact) else exact)

    return apply


def _extreme(is_better: Callable[[Number, Number], bool]) -> Callable[[Value, Value], Value]:
    def apply(first: Value, second: Value) -> Value:
        here, other = number(first).numbers_beside(number(second))
        return second if is_better(other, here) else first

    return apply


def _fabs(value: Value) -> Value:
    quantity = number(value)
    return Quantity(-quantity.number, quantity.unit) if quantity.number < 0 else quantity


def _fmod(dividend: Value, divisor: Value) -> Value:
    """Return the remainder with the sign of the first value, in its unit."""
    dividend, divisor = number(dividend), number(divisor)
    left, right = dividend.numbers_beside(divisor)
    if right == 0 or right != right or not is_finite(left):
        raise BadValue(f"it has no value for `{dividend}`, `{divisor}`")
    if not is_finite(right):
        return dividend
    remainder = abs(Fraction(left)) % abs(Fraction(right))
    return Quantity(-remainder if left < 0 else remainder, dividend.unit)


def _int(value: Value) -> Value:
    """Round down; true is 1."""
    quantity = _number_or_truth(value)
    if not math.isfinite(quantity.number):
        raise BadValue(f"`{quantity}` is not an integer")
    return Quantity(math.floor(quantity.number), quantity.unit)


def _double(value: Value) -> Value:
    quantity = _number_or_truth(value)
    exact = quantity.number
    return Quantity(Fraction(exact) if isinstance(exact, int) else exact, quantity.unit)


def _number_or_truth(value: Value) -> Quantity:
    return Quantity(int(value)) if isinstance(value, bool) else number(value)


def _string(value: Value) -> Value:
    """Format a value with six digits, and the unit."""
    if isinstance(value, str):
        raise BadValue(f"`{text_of(value)}` is a string already")
    if isinstance(value, Quantity) and not isinstance(value.number, int):
        return f"{float(value.number):g}{value.unit.name if value.unit else ''}"
    return text_of(value)


def _choose(index: Value, listed: Value) -> Value:
    if not isinstance(listed, str):
        raise BadValue(f"`{text_of(listed)}` is not a string")
    words = listed.split()
    return words[item_index(index, len(words))]


_OF_ONE_NUMBER = ("acos", "asin", "atan", "cos", "exp", "log", "log10", "sin", "sqrt", "tan")

FUNCTIONS: dict[str, tuple[str, Callable[..., Value]]] = {
    **{name: (f"{name}(x)", _of_plain_numbers(getattr(math, name))) for name in _OF_ONE_NUMBER},
    "atan2": ("atan2(y, x)", _of_plain_numbers(math.atan2)),
    "hypot": ("hypot(x, y)", _of_plain_numbers(math.hypot)),
    "pow": ("pow(x, y)", _of_plain_numbers(math.pow)),
    "ceil": ("ceil(x)", _rounded(math.ceil)),
    "floor": ("floor(x)", _rounded(math.floor)),
    "fabs": ("fabs(x)", _fabs),
    "fmod": ("fmod(x, y)", _fmod),
    "max": ("max(a, b)", _extreme(operator.gt)),
    "min": ("min(a, b)", _extreme(operator.lt)),
    "int": ("int(x)", _int),
    "double": ("double(x)", _double),
    "string": ("string(x)", _string),
    "choose": ('choose(index, "a b c")', _choose),
}
"""How each is written, and what it does, by name."""
