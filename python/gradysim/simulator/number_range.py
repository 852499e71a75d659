"""Whether what a user gave is a number in a range."""

import math
from numbers import Real


def is_in_range(value: object, low: float, high: float = math.inf, *, above: bool = False) -> bool:
    """Whether `value` is a number from `low` to `high`; never if it is NaN, a truth value or of another type.

    Without `high` any finite number from `low` on is right. With `above` the limit `low` itself is wrong, so
    that `is_in_range(value, -math.inf, above=True)` asks for any finite number.
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
