"""Confidence intervals of a mean, by Student's t distribution."""

import math
from collections.abc import Sequence
from fractions import Fraction
from functools import cache

CONFIDENCE = 0.95
"""Ratio of such intervals that contain the true mean."""

_LARGEST = 1000.0
"""Upper bound of all quantiles. The quantile of one degree of freedom is 12.7."""


def mean_of(values: Sequence[float]) -> float:
    """Return the mean of finite numbers, even if their sum overflows a float."""
    try:
        return math.fsum(values) / len(values)
    except OverflowError:
        return float(sum(map(Fraction, values)) / len(values))


def mean_with_half_width(values: Sequence[float]) -> tuple[float, float | None]:
    """Return the mean and half the width of its 95 % confidence interval, None for a single value.

    The values are assumed to be independent and normally distributed. A width that overflows a float is
    infinite.
    """
    if len(values) < 2:
        return mean_of(values), None
    # Relative to the smallest and largest value squares do not overflow. Halves do not, either.
    low = min(values) / 2
    half_range = max(values) / 2 - low
    if half_range == 0:
        return mean_of(values), 0.0
    relative = [(value / 2 - low) / half_range for value in values]
    mean = mean_of(relative)
    # A sum of `fsum` is the same in any order of the values.
    variance = math.fsum([(value - mean) ** 2 for value in relative]) / (len(values) - 1)
    half_width = _quantile(len(values) - 1) * math.sqrt(variance / len(values)) * half_range
    return mean_of(values), 2 * half_width


@cache
def _quantile(freedom: int) -> float:
    """Return the t that is exceeded in absolute value with probability 1 - CONFIDENCE; `freedom` >= 1."""
    low, high = 0.0, _LARGEST
    while high - low > 1e-9:
        middle = (low + high) / 2
        if _probability_within(middle, freedom) < CONFIDENCE:
            low = middle
        else:
            high = middle
    return high


def _probability_within(t: float, freedom: int) -> float:
    """Return the probability of values from -t to t.

    Source: M. Abramowitz and I. Stegun, Handbook of Mathematical Functions, 1964, 26.7.3 and 26.7.4.
    """
    theta = math.atan(t / math.sqrt(freedom))
    sine, cosine = math.sin(theta), math.cos(theta)
    odd = freedom % 2 == 1
    term = cosine if odd else 1.0
    total = term if freedom > 1 else 0.0
    for step in range(3 if odd else 2, freedom - 1, 2):
        term *= cosine * cosine * ((step - 1) / step)
        total += term
    return (theta + sine * total) * 2 / math.pi if odd else sine * total
