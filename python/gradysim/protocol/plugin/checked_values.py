"""Checks of what a user hands to a plugin; each error names the value, its purpose and what was expected."""

import math
from collections.abc import Callable
from contextlib import suppress
from numbers import Real
from typing import Any

from gradysim.protocol.position import Position


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
    try:
        x, y, z = map(float, () if isinstance(value, str) else value)
    except (TypeError, ValueError, OverflowError):
        x = y = z = math.nan
    if math.isfinite(x) and math.isfinite(y) and math.isfinite(z):
        return (x, y, z)
    raise error(f"{name} must be three finite numbers (x, y, z) in metres, got {value!r}")
