import math
from functools import cache

import pytest

from gradysim.results.confidence_interval import Estimate, estimate
from gradysim.results.paired import compare_pairs


def test_the_difference_is_that_of_runs_of_the_same_seed() -> None:
    compared = compare_pairs([10.0, 20.0, 30.0], [11.0, 21.0, 31.0])
    assert compared.pairs == 3
    assert compared.first == estimate([10.0, 20.0, 30.0])
    assert compared.second == estimate([11.0, 21.0, 31.0])
    assert compared.difference == Estimate(1.0, 1.0, 1.0)


def test_the_interval_is_that_of_student_for_the_differences() -> None:
    # Two differences, 0 and 2: deviation sqrt(2), quantile 12.706.
    difference = compare_pairs([1.0, 1.0], [1.0, 3.0]).difference
    assert (difference.mean, difference.half_width) == (1.0, pytest.approx(12.706, rel=1e-4))


def test_pairs_that_are_all_equal_do_not_show_that_an_event_is_as_probable() -> None:
    """With the two pairs that are added, the deviation is sqrt(2 / 6) and the quantile 2.447."""
    compared = compare_pairs([1, 0, 1, 1, 0], [1, 0, 1, 1, 0], binary=True)
    assert compared.first == estimate([1, 0, 1, 1, 0], binary=True)
    width = pytest.approx(2.447 * (2 / 6 / 7) ** 0.5, rel=1e-3)
    assert (compared.difference.mean, compared.difference.high) == (0, width)
    assert compared.difference.low == -compared.difference.high


@pytest.mark.parametrize(("changed", "excludes"), [(4, False), (5, True)])
def test_five_pairs_that_all_change_exclude_zero(changed: int, excludes: bool) -> None:
    difference = compare_pairs([1] * 5, [0] * changed + [1] * (5 - changed), binary=True).difference
    assert difference.low == -1
    assert difference.excludes_zero is excludes


def test_a_single_pair_of_events_has_no_interval() -> None:
    assert compare_pairs([0], [1], binary=True).difference == Estimate(1)


@pytest.mark.parametrize("count", [2, 5, 10, 20, 30])
def test_the_interval_of_a_difference_of_events_contains_it_in_94_of_100_studies(count: int) -> None:
    """For probabilities that one setting alone has the event, and that the other one alone has it."""
    for lost in (0.02, 0.1, 0.2, 0.5, 0.7):
        for gained in (0.0, 0.02, 0.1, 0.2):
            assert coverage_of_difference(count, lost, gained) > 0.94


def coverage_of_difference(count: int, lost: float, gained: float) -> float:
    """Return the probability of all outcomes of `count` pairs whose interval contains the difference."""
    total = 0.0
    for losses in range(count + 1):
        for gains in range(count + 1 - losses):
            others = count - losses - gains
            ways = math.comb(count, losses) * math.comb(count - losses, gains)
            probability = ways * lost**losses * gained**gains * (1 - lost - gained) ** others
            if probability > 1e-6 and contains(losses, gains, others, gained - lost):
                total += probability
    return total


@cache
def interval(losses: int, gains: int, others: int) -> Estimate:
    before = [1] * losses + [0] * (gains + others)
    after = [0] * losses + [1] * gains + [0] * others
    return compare_pairs(before, after, binary=True).difference


def contains(losses: int, gains: int, others: int, difference: float) -> bool:
    found = interval(losses, gains, others)
    assert found.low is not None
    assert found.high is not None
    return found.low <= difference <= found.high


@pytest.mark.parametrize(("first", "second"), [([], []), ([1.0], [1.0, 2.0])])
def test_numbers_without_a_partner_are_refused(first: list[float], second: list[float]) -> None:
    with pytest.raises(ValueError, match="pairs"):
        compare_pairs(first, second)
