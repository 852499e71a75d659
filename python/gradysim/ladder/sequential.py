"""Sequential tests: as many runs as it takes to decide whether a protocol works or fails.

Source: A. Wald, "Sequential tests of statistical hypotheses", Annals of Mathematical Statistics 16, 1945.
"""

import math
from collections.abc import Iterable

_CLOSEST = 0.02
"""Ratios are at least this far from 0 and 1, so that one odd run decides nothing."""


class SequentialTest:
    """Decides between two ratios of successful runs, with a given probability of an error.

    Attributes:
        successes: Number of successful runs so far.
        runs: Number of runs so far.
    """

    def __init__(self, high: float, low: float, error: float) -> None:
        """Start a test.

        Args:
            high: Ratio of successes where the protocol works, above `low`.
            low: Ratio of successes where it fails.
            error: Probability of the wrong decision, > 0 and < 0.5.
        """
        high, low = min(high, 1 - _CLOSEST), max(low, _CLOSEST)
        self._of_success, self._of_failure = math.log(high / low), math.log((1 - high) / (1 - low))
        self._bound = math.log((1 - error) / error)
        self.successes = self.runs = 0

    def add(self, outcomes: Iterable[bool]) -> None:
        """Add the outcomes of runs."""
        for works in outcomes:
            self.runs += 1
            self.successes += works

    @property
    def works(self) -> bool | None:
        """Whether the ratio is the high one; None if that is undecided."""
        failures = self.runs - self.successes
        log_ratio = self.successes * self._of_success + failures * self._of_failure
        return None if abs(log_ratio) < self._bound else log_ratio > 0


def probability_of_pairs(better: int, worse: int) -> float:
    """Return the probability of at least that many pairs in favor of the better setting, by chance alone.

    `better` pairs of runs with a common seed succeeded in it only, `worse` pairs in the other one only. It is
    the one-sided p of McNemar's exact test.

    Source: Q. McNemar, "Note on the sampling error of the difference between correlated proportions or
    percentages", Psychometrika 12, 1947.
    """
    pairs = better + worse
    return float(sum(math.comb(pairs, count) for count in range(better, pairs + 1)) / 2**pairs)
