"""Numbers as people read them, without what rounding has left in their last digits.

For texts only: results and files keep each number as it is.
"""

_DIGITS = 12
"""Sums of thousands of steps are right in as many. Of a time of hours they tell nanoseconds."""


def readable_number(number: float) -> float:
    """Return 59.9 for 59.90000000000058: `number` to twelve digits, but whole ones as they are."""
    return number if number % 1 == 0 or number != number else float(f"{number:.{_DIGITS}g}")
