"""Paired differences: what changes between two runs of the same seed, with its confidence interval."""

from collections.abc import Sequence
from dataclasses import dataclass

from gradysim.results.confidence_interval import mean_with_half_width


@dataclass(frozen=True)
class Estimate:
    """Mean of numbers, and half the width of its 95 % confidence interval; None for a single number."""

    mean: float
    half_width: float | None

    @property
    def excludes_zero(self) -> bool:
        """Whether 0 is outside of the interval. False without an interval."""
        return self.half_width is not None and abs(self.mean) > self.half_width


@dataclass(frozen=True)
class Comparison:
    """One quantity in two settings.

    Attributes:
        pairs: Number of pairs of runs.
        first: Of the runs with the first setting.
        second: Of the runs with the second setting.
        difference: Of the differences second - first within each pair.
    """

    pairs: int
    first: Estimate
    second: Estimate
    difference: Estimate


def compare_pairs(first: Sequence[float], second: Sequence[float]) -> Comparison:
    """Compare numbers of runs with two settings. `first[i]` and `second[i]` are of runs of the same seed.

    The interval of the difference is that of Student's t distribution for the paired differences, which are
    assumed to be independent and normally distributed. Runs of the same seed share most of their random
    draws, so this interval is narrower than that of two independent means.

    Raises ValueError if the lists are empty or of different lengths.
    """
    if not first or len(first) != len(second):
        raise ValueError(f"expected pairs of numbers, got {len(first)} and {len(second)} numbers")
    differences = [after - before for before, after in zip(first, second, strict=True)]
    return Comparison(len(first), *map(estimate, (first, second, differences)))


def estimate(values: Sequence[float]) -> Estimate:
    """Return the mean of at least one number, with its interval."""
    return Estimate(*mean_with_half_width(values))
