"""Sequential tests: as many runs as a decision takes. Repeated looks do not change the error rate."""

import math
from collections.abc import Iterable

_CLOSEST = 0.02
"""Ratios are at least this far from 0 and 1, so that one odd run decides nothing."""

_ALTERNATIVES = ((0.9, 0.95), (0.1, 0.75))
"""(weight, probability that a pair of runs that differs is in favor of the better setting)."""


class SequentialTest:
    """Decides between two ratios of successful runs, with a given probability of an error.

    Source: A. Wald, "Sequential tests of statistical hypotheses", Annals of Mathematical Statistics 16, 1945.

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


def evidence_of_pairs(better: int, worse: int) -> float:
    """Return the evidence that the better setting is better, from pairs of runs on a common seed.

    `better` pairs succeeded in the better setting only, `worse` pairs in the other one only. The value is a
    likelihood ratio: if the settings do not differ, it ever exceeds 1 / p with probability p at most, however
    often it is looked at.

    Source: J. Ville, "Étude critique de la notion de collectif", 1939 (the bound); Q. McNemar, "Note on the
    sampling error of the difference between correlated proportions or percentages", Psychometrika 12, 1947
    (the pairs).
    """
    return sum(weight * (2 * p) ** better * (2 * (1 - p)) ** worse for weight, p in _ALTERNATIVES)
