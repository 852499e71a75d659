"""How far two samples of the same thing may differ: tests of significance.

Each gives a p-value, the chance of a difference at least as large if there is none. A family of m
comparisons keeps its confidence if each p-value is above (1 - confidence) / m (Bonferroni), whether or not
the comparisons depend on each other. Those with the reference runs do: INET used the same random numbers at
every point of a curve.
"""

from collections.abc import Mapping, Sequence
from math import exp, lgamma, log1p, pi, sqrt
from statistics import fmean, variance
from typing import TypeVar

CONFIDENCE = 0.99
Comparison = TypeVar("Comparison")


def least_p(comparisons: int, confidence: float = CONFIDENCE) -> float:
    """The p-value that each of so many comparisons has to reach."""
    return (1 - confidence) / comparisons


def weakest(p_values: Mapping[Comparison, float]) -> tuple[Comparison, float]:
    """The comparison with the least p-value, and that."""
    return min(p_values.items(), key=lambda item: item[1])


def fisher_p(hits: int, trials: int, other_hits: int, other_trials: int) -> float:
    """Two counts of successes, of the same chance? Fisher's exact test, two-sided."""
    total, all_hits = trials + other_trials, hits + other_hits

    def log_chance(count: int) -> float:
        return (
            _log_choose(trials, count)
            + _log_choose(other_trials, all_hits - count)
            - _log_choose(total, all_hits)
        )

    limit = log_chance(hits) + 1e-7  # as likely as what was seen, but for rounding
    possible = range(max(0, all_hits - other_trials), min(trials, all_hits) + 1)
    return min(1.0, sum(exp(chance) for count in possible if (chance := log_chance(count)) <= limit))


def welch_p(sample: Sequence[float], other: Sequence[float]) -> float:
    """Two means of samples with possibly different spread: Welch's t test, two-sided."""
    errors = [variance(values) / len(values) for values in (sample, other)]
    t = abs(fmean(sample) - fmean(other)) / sqrt(sum(errors))
    freedom: float = sum(errors) ** 2 / sum(
        error**2 / (len(values) - 1) for error, values in zip(errors, (sample, other), strict=True)
    )
    return 2 * _student_tail(t, freedom)


def _student_tail(t: float, freedom: float) -> float:
    """The chance of a value above t >= 0 in Student's distribution, by Simpson's rule from 0 to t."""
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
