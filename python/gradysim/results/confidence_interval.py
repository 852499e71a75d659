"""Confidence intervals of a mean: by Student's t distribution, or exact bounds of a ratio of successes."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
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


@dataclass(frozen=True)
class Estimate:
    """Mean of numbers with its 95 % confidence interval.

    Attributes:
        low: Lower end of the interval; None for a single number.
        high: Upper end, likewise.
    """

    mean: float
    low: float | None = None
    high: float | None = None

    @property
    def half_width(self) -> float | None:
        """Half the width of the interval. The mean is in its middle, unless the numbers are binary."""
        return None if self.low is None or self.high is None else self.high / 2 - self.low / 2

    @property
    def excludes_zero(self) -> bool:
        """Whether 0 is outside of the interval. False without an interval."""
        return self.low is not None and self.high is not None and not self.low <= 0 <= self.high


def estimate(values: Sequence[float], *, binary: bool = False) -> Estimate:
    """Return the mean of independent numbers, at least one, with its interval.

    Numbers that are not binary are assumed to be normally distributed. The interval is then that of Student's
    t distribution. Ends that overflow a float are infinite.

    Args:
        values: The numbers, one for each run.
        binary: Whether each number says that an event occurred, 1, or not, 0. The interval is then that of
            `ratio_bounds`. Student's one would have no width if no run, or each run, had the event.

    Raises:
        ValueError: A binary number is neither 0 nor 1.
    """
    mean = mean_of(values)
    if len(values) < 2:
        return Estimate(mean)
    if binary:
        if not are_binary(values):
            raise ValueError(f"expected 0 and 1 as binary values, got {sorted(set(values))}")
        return Estimate(mean, *ratio_bounds(round(sum(values)), len(values), (1 - CONFIDENCE) / 2))
    half_width = _half_width(values)
    return Estimate(mean, mean - half_width, mean + half_width)


def are_binary(values: Iterable[float]) -> bool:
    """Return whether all values are 0 or 1."""
    return all(value in (0, 1) for value in values)


def _half_width(values: Sequence[float]) -> float:
    """Return half the width of the interval of Student's t distribution of two or more values."""
    # Relative to the smallest and largest value squares do not overflow. Halves do not, either.
    low = min(values) / 2
    half_range = max(values) / 2 - low
    if half_range == 0:
        return 0.0
    relative = [(value / 2 - low) / half_range for value in values]
    mean = mean_of(relative)
    # A sum of `fsum` is the same in any order of the values.
    variance = math.fsum([(value - mean) ** 2 for value in relative]) / (len(values) - 1)
    return 2 * _quantile(len(values) - 1) * math.sqrt(variance / len(values)) * half_range


def ratio_bounds(successes: int, count: int, error: float) -> tuple[float, float]:
    """Return the exact bounds of the ratio of which `successes` of `count` independent trials are a sample.

    The true ratio is below the first bound with probability `error` at most, and above the second one, too.
    So both are a 95 % confidence interval for `error` = 0.025. For 10 of 10 successes and an error of 0.05
    the first bound is 0.741: with 95 % confidence, at most 26 % of all trials fail.

    Source: C. J. Clopper and E. S. Pearson, The use of confidence or fiducial limits illustrated in the case
    of the binomial, Biometrika 26, 1934.

    Args:
        successes: 0 to `count`.
        count: 1 or more. A million takes up to 0.2 s.
        error: Above 0, 0.5 at most.

    Raises:
        ValueError: An argument is out of its range.
    """
    if not 0 <= successes <= count or count < 1 or not 0 < error <= 0.5:
        raise ValueError(f"expected 0 to `count` successes, got {successes} of {count} with error {error}")
    return _lower_bound(successes, count, error), 1 - _lower_bound(count - successes, count, error)


def _lower_bound(successes: int, count: int, error: float) -> float:
    """Return the ratio for which `successes` or more have the probability `error`; 0 for no success."""
    low, high = 0.0, successes / count
    while low < (middle := (low + high) / 2) < high:
        if _probability_of_at_least(successes, count, middle) < error:
            low = middle
        else:
            high = middle
    return low


def _probability_of_at_least(successes: int, count: int, ratio: float) -> float:
    """Return a tail of the binomial distribution, for 0 < `ratio` < `successes` / `count`.

    All terms are positive and each is smaller than the one before.
    """
    term = math.exp(
        math.lgamma(count + 1)
        - math.lgamma(successes + 1)
        - math.lgamma(count - successes + 1)
        + successes * math.log(ratio)
        + (count - successes) * math.log1p(-ratio)
    )
    odds, total = ratio / (1 - ratio), term
    for more in range(successes, count):
        term *= odds * (count - more) / (more + 1)
        if total + term == total:
            break
        total += term
    return total


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
