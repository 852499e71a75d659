"""The operators of two values, `$a < $b` or `3 * 50m`, with OMNeT++'s names, meanings and precedence."""

import operator
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from gradysim.scenario.errors import BadValue
from gradysim.scenario.value.pattern import compile_pattern
from gradysim.scenario.value.quantity import Quantity

Value = Quantity | str | bool


@dataclass(frozen=True)
class Operator:
    """One operator.

    Attributes:
        level: Of two operators the one with the higher level binds more tightly; of one level, the left one.
        apply: The result for the left and the right operand. Raises BadValue.
        decided_by: The truth of the left operand that is the result, whatever the right one is.
    """

    level: int
    apply: Callable[[Value, Value], Value]
    decided_by: bool | None = None


def truth(value: Value, sign: str) -> bool:
    """What a value says as an operand of a logical operator. Raises BadValue if it is not true or false."""
    if not isinstance(value, bool):
        raise BadValue(f"`{sign}` is for true and false, and `{text_of(value)}` is neither")
    return value


def number(value: Value) -> Quantity:
    """An operand of arithmetic. Raises BadValue if it is no number."""
    if not isinstance(value, Quantity):
        raise BadValue(f"arithmetic is for numbers only, and `{text_of(value)}` is none")
    return value


def text_of(value: Value) -> str:
    """A value as it is written."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return f'"{value}"' if isinstance(value, str) else str(value)


def power(base: Value, exponent: Value) -> Value:
    """The operator `^`, which alone takes its right operand first: 2^3^2 is 2^9."""
    return number(base).power(number(exponent))


def _logical(sign: str) -> Callable[[Value, Value], Value]:
    """`&&` or `||` where the left operand has not decided."""
    return lambda left, right: truth(right, sign)


def _sum(left: Value, right: Value) -> Value:
    if isinstance(left, str) and isinstance(right, str):
        return left + right
    return number(left).plus(number(right))


def _comparison(compare: Callable[[Any, Any], bool]) -> Callable[[Value, Value], Value]:
    """Of two numbers, whatever their units, of two texts by their characters, or of truths."""

    def apply(left: Value, right: Value) -> Value:
        if isinstance(left, Quantity) and isinstance(right, Quantity):
            return compare(*left.numbers_beside(right))
        if type(left) is type(right):
            return compare(left, right)
        is_chain = isinstance(left, bool)
        hint = "; several comparisons are joined by `&&`" if is_chain else ""
        raise BadValue(f"`{text_of(left)}` and `{text_of(right)}` cannot be compared", hint)

    return apply


def _matches(left: Value, right: Value) -> Value:
    if isinstance(left, str) and isinstance(right, str):
        return compile_pattern(right).matches(left)
    raise BadValue("`=~` is for a text and a pattern, both in quotes")


OPERATORS: dict[str, Operator] = {
    "||": Operator(0, _logical("||"), decided_by=True),
    "&&": Operator(1, _logical("&&"), decided_by=False),
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
"""By sign."""
