"""Checks of numbers, points and ranges that users pass to plugins and simulators.

Each error names the value, its purpose and what is expected.
"""

import math
from numbers import Real
from typing import Any

from gradysim.protocol.position import Position

_PLAIN = (float, int)


def is_in_range(value: Any, low: float = -math.inf, high: float = math.inf, *, above: bool = False) -> bool:
    """Return whether `value` is a finite number from `low` to `high`. A bool is not a number.

    With `above`, `low` itself is not in the range.
    """
    # The check of an abstract class takes several times as long as that of a type.
    if type(value) not in _PLAIN and (not isinstance(value, Real) or isinstance(value, bool)):
        return False
    try:
        number = float(value)
    except OverflowError:
        return False
    return math.isfinite(number) and low <= number <= high and not (above and number == low)


def checked_number(
    name: str,
    value: Any,
    low: float = -math.inf,
    high: float = math.inf,
    *,
    above: bool = False,
    infinite: bool = False,
    unit: str = "",
    error: type[Exception] = ValueError,
) -> float:
    """Return `value` as a float if it is in the range of `is_in_range`, otherwise raise `error`.

    With `infinite`, infinity is valid, too. `name` and `unit` are for the message.
    """
    if is_in_range(value, low, high, above=above):
        return float(value)
    if infinite and isinstance(value, Real) and value == math.inf:
        return math.inf
    if high < math.inf:
        expected = f"> {low} and <= {high} {unit}" if above else f"from {low} to {high} {unit}"
    elif low > -math.inf:
        expected = f"{'' if infinite else 'finite and '}{'>' if above else '>='} {low} {unit}"
    else:
        expected = f"a finite number of {unit}" if unit else "a finite number"
    raise error(f"{name} must be {expected.rstrip()}, got {value!r}")


def checked_point(name: str, value: Any, error: type[Exception]) -> Position:
    """Return `value` as (x, y, z) if it is three finite numbers, otherwise raise `error`."""
    numbers = _finite_numbers(value)
    if len(numbers) != 3:
        raise error(f"{name} must be three finite numbers (x, y, z) in meters, got {value!r}")
    return (numbers[0], numbers[1], numbers[2])


def checked_range(name: str, value: Any, error: type[Exception]) -> tuple[float, float]:
    """Return `value` as (lowest, highest) if it is two finite numbers in order, otherwise raise `error`."""
    numbers = _finite_numbers(value)
    if len(numbers) != 2 or numbers[0] > numbers[1]:
        raise error(
            f"{name} must be two finite numbers (lowest, highest) in meters, the lowest first, got {value!r}"
        )
    return (numbers[0], numbers[1])


def _finite_numbers(value: Any) -> tuple[float, ...]:
    """Return the elements of `value` as floats; nothing if one is not a finite number."""
    try:
        numbers = tuple(map(float, () if isinstance(value, str) else value))
    except (TypeError, ValueError, OverflowError):
        return ()
    return numbers if all(map(math.isfinite, numbers)) else ()
