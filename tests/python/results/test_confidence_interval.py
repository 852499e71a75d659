import math
import sys
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.results.confidence_interval import Estimate, estimate, mean_of, ratio_bounds


@pytest.mark.parametrize(
    ("runs", "quantile"),
    [(2, 12.706), (3, 4.303), (4, 3.182), (5, 2.776), (10, 2.262), (11, 2.228), (31, 2.042), (121, 1.980)],
)
def test_half_widths_agree_with_the_table_of_student(runs: int, quantile: float) -> None:
    """For values 0 and 1, half of each, or one more 0. Their standard deviation is known."""
    ones = runs // 2
    values = [1.0] * ones + [0.0] * (runs - ones)
    mean = ones / runs
    deviation = (runs * mean * (1 - mean) / (runs - 1)) ** 0.5
    found = estimate(values)
    assert found.mean == pytest.approx(mean)
    assert found.half_width == pytest.approx(quantile * deviation / runs**0.5, rel=3e-4)
    assert (found.low, found.high) == (
        pytest.approx(mean - found.half_width),
        pytest.approx(mean + found.half_width),
    )


def test_a_single_value_has_no_interval() -> None:
    assert estimate([3.0]) == estimate([3.0], binary=True) == Estimate(3.0, None, None)


@given(st.floats(-1e6, 1e6), st.integers(2, 50))
def test_equal_values_have_an_interval_of_no_width(value: float, runs: int) -> None:
    found = estimate([value] * runs)
    assert (found.mean, found.half_width) == (pytest.approx(value), pytest.approx(0, abs=1e-6))


@given(st.lists(st.floats(-100, 100), min_size=2, max_size=20), st.floats(-100, 100))
def test_an_interval_moves_with_its_values(values: list[float], by: float) -> None:
    found, moved = estimate(values), estimate([value + by for value in values])
    assert moved.mean == pytest.approx(found.mean + by, abs=1e-9)
    assert moved.half_width == pytest.approx(found.half_width, abs=1e-6)


HUGE = sys.float_info.max


@pytest.mark.parametrize(
    ("values", "mean"),
    [
        ([HUGE, HUGE], HUGE),
        ([HUGE] * 3, HUGE),
        ([-HUGE, -HUGE, HUGE], -HUGE / 3),
        ([HUGE, -HUGE], 0),
        ([HUGE, 1], HUGE / 2),
    ],
)
def test_a_mean_may_be_of_numbers_whose_sum_is_none(values: list[float], mean: float) -> None:
    assert mean_of(values) == mean
    assert estimate(values).mean == mean


@pytest.mark.parametrize(
    ("values", "half_width"),
    [
        ([HUGE] * 3, 0),
        ([HUGE, -HUGE], math.inf),
        ([HUGE, -HUGE] * 50, pytest.approx(1.98422 / math.sqrt(99) * HUGE, rel=1e-5)),
        ([0.0, 1e290], pytest.approx(12.7062 * 1e290 / 2, rel=1e-5)),
        ([0.0, 0.0, -HUGE, -HUGE], math.inf),  # the lower end, not half of the width
    ],
)
def test_an_interval_may_be_of_huge_numbers(values: list[float], half_width: float) -> None:
    assert estimate(values).half_width == half_width


@pytest.mark.parametrize(
    ("values", "successes"), [([0, 0, 0], 0), ([1.0, 1.0, 1.0], 3), ([True, False, 1], 2)]
)
def test_the_interval_of_an_event_is_exact(values: list[float], successes: int) -> None:
    found = estimate(values, binary=True)
    assert found.mean == successes / 3
    assert (found.low, found.high) == pytest.approx(ratio_bounds(successes, 3, 0.025))


def test_an_event_happens_or_not() -> None:
    with pytest.raises(ValueError, match=r"got \[0, 2\]"):
        estimate([0, 2, 0], binary=True)


@pytest.mark.parametrize(
    ("ends", "excludes"),
    [((-5, -1), True), ((0, 4), False), ((1, 1), True), ((0, 0), False), ((None, None), False)],
)
def test_an_interval_excludes_zero_or_not(ends: tuple[float | None, float | None], excludes: bool) -> None:
    assert Estimate(2, *ends).excludes_zero is excludes


@pytest.mark.parametrize(
    ("successes", "count", "error", "bounds"),
    [
        (0, 10, 0.025, (0, 0.3085)),
        (1, 10, 0.025, (0.0025, 0.4450)),
        (5, 10, 0.025, (0.1871, 0.8129)),
        (10, 10, 0.05, (0.7411, 1)),
        (0, 1, 0.5, (0, 0.5)),
        (500_000, 1_000_000, 0.025, (0.49902, 0.50098)),
    ],
)
def test_bounds_of_a_ratio_agree_with_tables(
    successes: int, count: int, error: float, bounds: tuple[float, float]
) -> None:
    assert ratio_bounds(successes, count, error) == pytest.approx(bounds, abs=5e-5)


def test_lower_bounds_of_a_million_trials_have_a_closed_form() -> None:
    """The probability of the successes is ratio^n for n of n, and 1 - (1 - ratio)^n for at least 1 of n."""
    count, error = 1_000_000, 0.025
    one = -math.expm1(math.log1p(-error) / count)
    assert ratio_bounds(count, count, error)[0] == pytest.approx(error ** (1 / count), rel=1e-12)
    assert ratio_bounds(1, count, error)[0] == pytest.approx(one, rel=1e-8)


@given(st.integers(1, 40), st.data(), st.floats(1e-9, 0.5))
def test_at_a_bound_so_many_successes_have_the_probability_of_the_error(
    count: int, data: st.DataObject, error: float
) -> None:
    successes = data.draw(st.integers(1, count))
    ratio = Fraction(ratio_bounds(successes, count, error)[0])
    terms = (math.comb(count, k) * ratio**k * (1 - ratio) ** (count - k) for k in range(successes, count + 1))
    assert float(sum(terms)) == pytest.approx(error, rel=1e-9)


@given(st.integers(1, 10_000), st.data(), st.floats(1e-9, 0.5))
def test_bounds_of_failures_mirror_those_of_successes(count: int, data: st.DataObject, error: float) -> None:
    successes = data.draw(st.integers(0, count))
    low, high = ratio_bounds(successes, count, error)
    assert 0 <= low <= successes / count <= high <= 1
    assert ratio_bounds(count - successes, count, error) == pytest.approx((1 - high, 1 - low), abs=1e-15)


@pytest.mark.parametrize(
    ("successes", "count", "error"), [(2, 1, 0.025), (-1, 1, 0.025), (0, 0, 0.025), (1, 2, 0), (1, 2, 0.6)]
)
def test_bounds_need_a_ratio_and_an_error(successes: int, count: int, error: float) -> None:
    with pytest.raises(ValueError, match=f" {successes} of {count} .* {error}"):
        ratio_bounds(successes, count, error)
