"""Checks of numbers, points and ranges that users pass to plugins and simulators.

Each error names the value, its purpose and what is expected.
"""

import math
from collections.abc import Callable
from contextlib import suppress
from numbers import Real
from typing import Any

from gradysim.protocol.position import Position


def is_plain_number(value: object) -> bool:
    """Return whether `value` is an int or a float, as JSON has them, and not a bool."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def is_in_range(value: object, low: float, high: float = math.inf, *, above: bool = False) -> bool:
    """Return whether `value` is a number from `low` to `high`. NaN, a bool and other types are not.

    Without `high`, every finite number >= `low` is in the range. With `above`, `low` itself is not:
    `is_in_range(value, -math.inf, above=True)` accepts every finite number.
    """
    if not isinstance(value, Real) or isinstance(value, bool):
        return False
    try:
        number = float(value)
    except OverflowError:
        return False
    if number == math.inf or not low <= number <= high:
        return False
    return number > low if above else True


def checked_number(
    name: str, value: Any, accept: Callable[[float], bool], expected: str, error: type[Exception]
) -> float:
    """Return `value` as a float if it is a number that `accept` accepts. Otherwise raise `error`.

    `accept` must reject NaN, as every comparison does. `expected` completes "... must be".
    """
    with suppress(OverflowError):  # of an integer that no double can hold
        if isinstance(value, Real) and not isinstance(value, bool) and accept(float(value)):
            return float(value)
    raise error(f"{name} must be {expected}, got {value!r}")


def checked_point(name: str, value: Any, error: type[Exception]) -> Position:
    """Return `value` as (x, y, z) if it is three finite numbers, otherwise raise `error`."""
    numbers = _finite_numbers(value)
    if len(numbers) != 3:
        raise error(f"{name} must be three finite numbers (x, y, z) in metres, got {value!r}")
    return (numbers[0], numbers[1], numbers[2])


def checked_range(name: str, value: Any, error: type[Exception]) -> tuple[float, float]:
    """Return `value` as (lowest, highest) if it is two finite numbers in order, otherwise raise `error`."""
    numbers = _finite_numbers(value)
    if len(numbers) != 2 or numbers[0] > numbers[1]:
        raise error(
            f"{name} must be two finite numbers (lowest, highest) in metres, the lowest first, got {value!r}"
        )
    return (numbers[0], numbers[1])


def _finite_numbers(value: Any) -> tuple[float, ...]:
    """Return the elements of `value` as floats; nothing if one is not a finite number."""
    try:
        numbers = tuple(map(float, () if isinstance(value, str) else value))
    except (TypeError, ValueError, OverflowError):
        return ()
    return numbers if all(map(math.isfinite, numbers)) else ()
