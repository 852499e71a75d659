import math
from random import Random

import pytest

from gradysim.ladder.sequential import SequentialTest, evidence_of_pairs


def decision(test: SequentialTest, outcomes: list[bool]) -> tuple[int, bool | None]:
    """Return after how many runs a test decides, and how."""
    for count, works in enumerate(outcomes, 1):
        test.add([works])
        if test.works is not None:
            return count, test.works
    return len(outcomes), None


def test_without_runs_nothing_is_decided() -> None:
    assert SequentialTest(0.9, 0.1, 0.01).works is None


@pytest.mark.parametrize("works", [True, False])
def test_equal_outcomes_decide_after_the_number_of_runs_that_wald_gives(works: bool) -> None:
    # Each outcome multiplies the likelihood ratio by 0.9 / 0.1; an error of 1 % needs a ratio of 99.
    expected = math.ceil(math.log(99) / math.log(9))
    assert decision(SequentialTest(0.9, 0.1, 0.01), [works] * 100) == (expected, works)


def test_an_outcome_and_its_opposite_cancel_out_if_the_ratios_are_symmetric() -> None:
    assert decision(SequentialTest(0.9, 0.1, 0.01), [True, False] * 100) == (200, None)


def test_one_odd_run_does_not_decide_between_always_and_never() -> None:
    assert decision(SequentialTest(1, 0, 0.01), [False]) == (1, None)
    assert decision(SequentialTest(1, 0, 0.01), [False, True, True, True]) == (4, True)


@pytest.mark.parametrize(("high", "low"), [(1, 0), (0.9, 0.5), (0.95, 0.2)])
def test_errors_are_as_rare_as_promised(high: float, low: float) -> None:
    random = Random(1)
    error, wrong = 0.05, 0
    for number in range(300):
        works = number % 2 == 0
        ratio = high if works else low
        outcomes = [random.random() < ratio for _ in range(2000)]
        wrong += decision(SequentialTest(high, low, error), outcomes)[1] != works
    # 5 % of 300 are 15. More than 27 have a probability of 0.2 %.
    assert wrong <= 27


def test_pairs_in_favor_of_one_setting_are_evidence() -> None:
    assert evidence_of_pairs(0, 0) == 1
    assert evidence_of_pairs(8, 0) > 140  # of a protocol that always breaks, after eight pairs
    assert evidence_of_pairs(0, 8) < 0.01
    assert evidence_of_pairs(10, 10) < 1


def test_evidence_is_rarely_wrong_however_often_one_looks() -> None:
    """Settings that do not differ: each pair that differs is in favor of either."""
    random = Random(1)
    wrong = 0
    for _ in range(500):
        better = worse = 0
        for _ in range(200):
            better, worse = (better + 1, worse) if random.random() < 0.5 else (better, worse + 1)
            if evidence_of_pairs(better, worse) > 20:
                wrong += 1
                break
    # 5 % of 500 are 25. More than 37 have a probability of 0.5 %.
    assert wrong <= 37
