"""Differences between two samples of the same quantity: significance tests.

Each gives a p-value, the probability of a difference at least as large if there is none. A family of m
comparisons keeps its confidence if each p-value is above (1 - confidence) / m (Bonferroni). This holds also
for dependent comparisons, such as those with the reference runs: INET used the same random numbers at every
point of a curve.
"""

from collections.abc import Mapping, Sequence
from math import exp, lgamma, log1p, pi, sqrt
from statistics import fmean, variance
from typing import TypeVar

CONFIDENCE = 0.99
Comparison = TypeVar("Comparison")


def least_p(comparisons: int, confidence: float = CONFIDENCE) -> float:
    """Return the p-value that each of that many comparisons must reach."""
    return (1 - confidence) / comparisons


def weakest(p_values: Mapping[Comparison, float]) -> tuple[Comparison, float]:
    """Return the comparison with the smallest p-value, and the p-value."""
    return min(p_values.items(), key=lambda item: item[1])


def fisher_p(hits: int, trials: int, other_hits: int, other_trials: int) -> float:
    """Compare two counts of successes: Fisher's exact test, two-sided."""
    total, all_hits = trials + other_trials, hits + other_hits

    def log_chance(count: int) -> float:
        return (
            _log_choose(trials, count)
            + _log_choose(other_trials, all_hits - count)
            - _log_choose(total, all_hits)
        )

    limit = log_chance(hits) + 1e-7  # as likely as the observation, except for rounding
    possible = range(max(0, all_hits - other_trials), min(trials, all_hits) + 1)
    return min(1.0, sum(exp(chance) for count in possible if (chance := log_chance(count)) <= limit))


def welch_p(sample: Sequence[float], other: Sequence[float]) -> float:
    """Compare two means of samples with possibly different variance: Welch's t test, two-sided."""
    errors = [variance(values) / len(values) for values in (sample, other)]
    t = abs(fmean(sample) - fmean(other)) / sqrt(sum(errors))
    freedom: float = sum(errors) ** 2 / sum(
        error**2 / (len(values) - 1) for error, values in zip(errors, (sample, other), strict=True)
    )
    return 2 * _student_tail(t, freedom)


def _student_tail(t: float, freedom: float) -> float:
    """Return the probability of a value above t >= 0 in Student's distribution, by Simpson's rule."""
    factor = exp(lgamma((freedom + 1) / 2) - lgamma(freedom / 2)) / sqrt(freedom * pi)
    steps = 2000
    width = t / steps
    total = sum(
        (1 if i in (0, steps) else 4 if i % 2 else 2)
        * exp(-(freedom + 1) / 2 * log1p((i * width) ** 2 / freedom))
        for i in range(steps + 1)
    )
    return max(0.0, 0.5 - factor * total * width / 3)


def _log_choose(n: int, k: int) -> float:
    return lgamma(n + 1) - lgamma(k + 1) - lgamma(n - k + 1)
