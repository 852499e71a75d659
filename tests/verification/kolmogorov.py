"""The Kolmogorov-Smirnov test of a sample's distribution."""

from collections.abc import Callable, Sequence
from math import exp, sqrt


def ks_distance(sample: Sequence[float], distribution: Callable[[float], float]) -> float:
    """Return the largest difference between the sample's distribution function and the given one."""
    ordered = sorted(sample)
    count = len(ordered)
    return max(
        max((index + 1) / count - share, share - index / count)
        for index, share in ((index, distribution(value)) for index, value in enumerate(ordered))
    )


def ks_p(distance: float, count: int) -> float:
    """Return the probability of a distance at least as large for a sample of `count` values, two-sided.

    Source: M. A. Stephens, "Use of the Kolmogorov-Smirnov, Cramer-von Mises and related statistics without
    extensive tables", Journal of the Royal Statistical Society B 32, 1970: Kolmogorov's limit, corrected for
    the size.
    """
    scaled = distance * (sqrt(count) + 0.12 + 0.11 / sqrt(count))
    if scaled < 0.3:
        return 1.0
    return min(1.0, 2 * sum((1 if k % 2 else -1) * exp(-2 * (k * scaled) ** 2) for k in range(1, 30)))
