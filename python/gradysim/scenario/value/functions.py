"""Functions of values by OMNeT++'s names: `max(1s, 200ms)`, `int(7 / 2)`, `select(2, 10m, 20m, 50m)`.

Those that draw, and those that know the parameter that their value is for, are elsewhere: `drawing_functions`
and `parameter_context`.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from gradysim.scenario.errors import BadValue
from gradysim.scenario.value.operators import Value, number, text_of
from gradysim.scenario.value.quantity import Number, Quantity, is_finite


@dataclass(frozen=True)
class _Function:
    """One function: how it is written, with the names of its values, and what it gives."""

    written: str
    apply: Callable[[Sequence[Value]], Value]

    def takes(self, count: int) -> bool:
        """Whether it can be called with so many values."""
        return count == self.written.count(",") + 1


def call(name: str, values: Sequence[Value]) -> Value:
    """What the function of that name, one of FUNCTIONS, gives.

    Raises:
        BadValue: It takes other values.
    """
    function = FUNCTIONS[name]
    if not function.takes(len(values)):
        raise BadValue(f"`{function.written}` does not take {len(values)} values")
    try:
        return function.apply(values)
    except BadValue as error:
        raise error.with_problem(f"`{name}`: {error.problem}") from None


def _of_plain_numbers(function: Callable[..., float]) -> Callable[[Sequence[Value]], Value]:
    """A function of Python's module math. It is an error where that has no value."""

    def apply(values: Sequence[Value]) -> Value:
        numbers = [_plain(value) for value in values]
        try:
            return Quantity(function(*numbers))
        except (ValueError, OverflowError):
            raise BadValue(
                f"it has no value for {', '.join(f'`{text_of(value)}`' for value in values)}"
            ) from None

    return apply


def _plain(value: Value) -> float:
    quantity = number(value)
    if quantity.unit is not None:
        raise BadValue(f"`{quantity}` is no plain number")
    return float(quantity.number)


def _rounded(rounding: Callable[[Number], int]) -> Callable[[Sequence[Value]], Value]:
    """As OMNeT++ has it, no whole number but one with a point, which only `int` makes whole."""

    def apply(values: Sequence[Value]) -> Value:
        (value,) = values
        _plain(value)
        exact = number(value).number
        if math.isfinite(exact):
            return Quantity(Fraction(rounding(exact)))
        return Quantity(exact)

    return apply


def _extreme(is_better: Callable[[Number, Number], bool]) -> Callable[[Sequence[Value]], Value]:
    def apply(values: Sequence[Value]) -> Value:
        first, second = (number(value) for value in values)
        here, other = first.numbers_beside(second)
        return second if is_better(other, here) else first

    return apply


def _fabs(values: Sequence[Value]) -> Value:
    quantity = number(values[0])
    return Quantity(-quantity.number, quantity.unit) if quantity.number < 0 else quantity


def _fmod(values: Sequence[Value]) -> Value:
    """The remainder with the sign of the first value, in its unit."""
    dividend, divisor = (number(value) for value in values)
    left, right = dividend.numbers_beside(divisor)
    if right == 0 or right != right or not is_finite(left):
        raise BadValue(f"it has no value for `{dividend}`, `{divisor}`")
    if not is_finite(right):
        return dividend
    remainder = abs(Fraction(left)) % abs(Fraction(right))
    return Quantity(-remainder if left < 0 else remainder, dividend.unit)


def _int(values: Sequence[Value]) -> Value:
    """Rounded down. Truth counts as 1."""
    quantity = _number_or_truth(values[0])
    if not math.isfinite(quantity.number):
        raise BadValue(f"`{quantity}` is no whole number")
    return Quantity(math.floor(quantity.number), quantity.unit)


def _double(values: Sequence[Value]) -> Value:
    quantity = _number_or_truth(values[0])
    exact = quantity.number
    return Quantity(Fraction(exact) if isinstance(exact, int) else exact, quantity.unit)


def _number_or_truth(value: Value) -> Quantity:
    return Quantity(int(value)) if isinstance(value, bool) else number(value)


def _string(values: Sequence[Value]) -> Value:
    """With six digits, and the unit."""
    (value,) = values
    if isinstance(value, str):
        raise BadValue(f"`{text_of(value)}` is a text already")
    if isinstance(value, Quantity) and not isinstance(value.number, int):
        return f"{float(value.number):g}{value.unit.name if value.unit else ''}"
    return text_of(value)


def _choose(values: Sequence[Value]) -> Value:
    index, listed = values
    if not isinstance(listed, str):
        raise BadValue(f"`{text_of(listed)}` is no text")
    words = listed.split()
    return words[place_of(index, len(words))]


def place_of(index: Value, count: int) -> int:
    """The place of one of `count` items. Raises BadValue if the index is none of theirs."""
    place = number(index)
    if place.unit is not None or not isinstance(place.number, int):
        raise BadValue(f"`{place}` is no whole number")
    if not 0 <= place.number < count:
        raise BadValue(f"there is no item {place}, only 0 to {count - 1}")
    return place.number


SELECT, SELECT_WRITTEN = "select", "select(index, a, b, ...)"
"""The function that does not need the values of all that stands in it: `expression` has it."""

FUNCTIONS: dict[str, _Function] = {
    **{
        name: _Function(f"{name}(x)", _of_plain_numbers(getattr(math, name)))
        for name in ("acos", "asin", "atan", "cos", "exp", "log", "log10", "sin", "sqrt", "tan")
    },
    "atan2": _Function("atan2(y, x)", _of_plain_numbers(math.atan2)),
    "hypot": _Function("hypot(x, y)", _of_plain_numbers(math.hypot)),
    "pow": _Function("pow(x, y)", _of_plain_numbers(math.pow)),
    "ceil": _Function("ceil(x)", _rounded(math.ceil)),
    "floor": _Function("floor(x)", _rounded(math.floor)),
    "fabs": _Function("fabs(x)", _fabs),
    "fmod": _Function("fmod(x, y)", _fmod),
    "max": _Function("max(a, b)", _extreme(lambda other, first: other > first)),
    "min": _Function("min(a, b)", _extreme(lambda other, first: other < first)),
    "int": _Function("int(x)", _int),
    "double": _Function("double(x)", _double),
    "string": _Function("string(x)", _string),
    "choose": _Function('choose(index, "a b c")', _choose),
}
"""By name."""
