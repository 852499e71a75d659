"""Paired differences: what changes between two runs of the same seed, with its confidence interval."""

from collections.abc import Sequence
from dataclasses import dataclass

from gradysim.results.confidence_interval import Estimate, estimate, mean_of


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


def compare_pairs(first: Sequence[float], second: Sequence[float], *, binary: bool = False) -> Comparison:
    """Compare numbers of runs with two settings. `first[i]` and `second[i]` are of runs of the same seed.

    The interval of the difference is that of Student's t distribution for the paired differences, which are
    assumed to be independent and normally distributed. Runs of the same seed share most of their random
    draws, so this interval is narrower than that of two independent means.

    `binary` numbers are 0 or 1, as in `estimate`. Their differences are often all 0, which does not show that
    the settings are equal. So the interval of the difference is that of the pairs and of two more, one with
    an event in the first setting alone and one with an event in the second setting alone.

    Source: D. G. Bonett and R. M. Price, Adjusted Wald confidence interval for a difference of binomial
    proportions based on paired data, Journal of Educational and Behavioral Statistics 37, 2012. Here with
    Student's t distribution, which matters below 30 pairs.

    Raises ValueError if the lists are empty or of different lengths, and as `estimate`.
    """
    if not first or len(first) != len(second):
        raise ValueError(f"expected pairs of numbers, got {len(first)} and {len(second)} numbers")
    differences = [after - before for before, after in zip(first, second, strict=True)]
    of_first, of_second = (estimate(values, binary=binary) for values in (first, second))
    difference = _of_binary(differences) if binary else estimate(differences)
    return Comparison(len(first), of_first, of_second, difference)


def _of_binary(differences: Sequence[float]) -> Estimate:
    mean, wider = mean_of(differences), estimate([*differences, 1.0, -1.0])
    if len(differences) < 2 or wider.low is None or wider.high is None:
        return Estimate(mean)
    return Estimate(mean, max(-1.0, wider.low), min(1.0, wider.high))
