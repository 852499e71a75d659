import pytest

from gradysim.results.confidence_interval import mean_with_half_width
from gradysim.results.paired import Estimate, compare_pairs


def test_the_difference_is_that_of_runs_of_the_same_seed() -> None:
    compared = compare_pairs([10.0, 20.0, 30.0], [11.0, 21.0, 31.0])
    assert compared.pairs == 3
    assert compared.first == Estimate(*mean_with_half_width([10.0, 20.0, 30.0]))
    assert compared.second == Estimate(*mean_with_half_width([11.0, 21.0, 31.0]))
    assert compared.difference == Estimate(1.0, 0.0)


def test_the_interval_is_that_of_student_for_the_differences() -> None:
    # Two differences, 0 and 2: deviation sqrt(2), quantile 12.706.
    difference = compare_pairs([1.0, 1.0], [1.0, 3.0]).difference
    assert (difference.mean, difference.half_width) == (1.0, pytest.approx(12.706, rel=1e-4))


@pytest.mark.parametrize(
    ("mean", "half_width", "excludes"),
    [(-3.0, 2.0, True), (2.0, 2.0, False), (1.0, 0.0, True), (0.0, 0.0, False), (5.0, None, False)],
)
def test_an_interval_excludes_zero_or_not(mean: float, half_width: float | None, excludes: bool) -> None:
    assert Estimate(mean, half_width).excludes_zero is excludes


@pytest.mark.parametrize(("first", "second"), [([], []), ([1.0], [1.0, 2.0])])
def test_numbers_without_a_partner_are_refused(first: list[float], second: list[float]) -> None:
    with pytest.raises(ValueError, match="expected pairs of numbers"):
        compare_pairs(first, second)
