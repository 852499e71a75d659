"""How often the interval of an event contains its probability: computed from all outcomes of a study."""

from functools import cache
from math import comb

import numpy as np
import pytest

from gradysim.cli.until import BATCH, percent_of_mean
from gradysim.results.confidence_interval import Estimate, estimate
from python.thorough import some

RARE_TO_EVEN = (0.02, 0.05, 0.1, 0.2, 0.3, 0.5)

REPEAT = {5: 200, 10: 500, 20: 1000, 50: 1000}
"""The largest number of runs, by percent."""


@cache
def interval(events: int, runs: int) -> Estimate:
    return estimate([1] * events + [0] * (runs - events), binary=True)


def contains(events: int, runs: int, probability: float) -> bool:
    found = interval(events, runs)
    assert found.low is not None
    assert found.high is not None
    return found.low <= probability <= found.high


def of_events(runs: int, probability: float) -> list[float]:
    """Return the probability of 0, 1, … events in some runs."""
    return [comb(runs, k) * probability**k * (1 - probability) ** (runs - k) for k in range(runs + 1)]


@pytest.mark.parametrize("runs", [2, 5, 10, 20, 50, 100])
def test_after_a_fixed_number_of_runs(runs: int) -> None:
    for probability in RARE_TO_EVEN:
        chances = enumerate(of_events(runs, probability))
        assert sum(chance for events, chance in chances if contains(events, runs, probability)) >= 0.95


@pytest.mark.parametrize("percent", some(REPEAT))
def test_after_until_has_stopped(percent: float) -> None:
    for hundredths in range(2, 99):
        assert coverage(percent, hundredths / 100) >= 0.93


def coverage(percent: float, probability: float) -> float:
    """Return the probability that the interval contains the probability once `--until` has stopped."""
    covered, runs, least, chances = 0.0, 0, 1, np.ones(1)
    while runs < REPEAT[percent] and chances.sum() > 1e-6:
        chances = np.convolve(chances, of_events(BATCH, probability))
        runs += BATCH
        least = least_events(runs, percent, least - 1) if runs < REPEAT[percent] else 0
        stopped = list(range(least, len(chances)))
        if percent_of_mean(interval(0, runs)) < percent:
            stopped.insert(0, 0)
        for events in stopped:
            if chances[events] > 1e-9 and contains(events, runs, probability):
                covered += chances[events]
            chances[events] = 0.0
        chances = chances[: max(least, 1)]
    return covered


def least_events(runs: int, percent: float, start: int) -> int:
    """Return the least number of events, above 0, that is enough. It does not decrease with more runs."""
    events = max(start, 1)
    while events <= runs and percent_of_mean(interval(events, runs)) >= percent:
        events += 1
    return events
