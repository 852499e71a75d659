"""Checks of what a user hands over as number, point or range, for plugins and for simulators.

Each error names the value, its purpose and what was expected.
"""

import math
from collections.abc import Callable
from contextlib import suppress
from numbers import Real
from typing import Any

from gradysim.protocol.position import Position


def is_plain_number(value: object) -> bool:
    """Whether it is an int or a float, which JSON has, too; a truth value is none."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def checked_number(
    name: str, value: Any, accept: Callable[[float], bool], expected: str, error: type[Exception]
) -> float:
    """Return `value` if it is a number that `accept` takes, otherwise raise `error`.

    NaN is for `accept` to refuse, which every comparison does. `expected` completes "... must be".
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
    """Return the elements of `value` as numbers; none if one of them is not finite, or it has no elements."""
    try:
        numbers = tuple(map(float, () if isinstance(value, str) else value))
    except (TypeError, ValueError, OverflowError):
        return ()
    return numbers if all(map(math.isfinite, numbers)) else ()
