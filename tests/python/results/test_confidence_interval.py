import math
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.results.confidence_interval import mean_of, mean_with_half_width


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
    assert mean_with_half_width(values) == (
        pytest.approx(mean),
        pytest.approx(quantile * deviation / runs**0.5, rel=3e-4),
    )


def test_a_single_value_has_no_interval() -> None:
    assert mean_with_half_width([3.0]) == (3.0, None)


@given(st.floats(-1e6, 1e6), st.integers(2, 50))
def test_equal_values_have_an_interval_of_no_width(value: float, runs: int) -> None:
    mean, half_width = mean_with_half_width([value] * runs)
    assert (mean, half_width) == (pytest.approx(value), pytest.approx(0, abs=1e-6))


@given(st.lists(st.floats(-100, 100), min_size=2, max_size=20), st.floats(-100, 100))
def test_an_interval_moves_with_its_values(values: list[float], by: float) -> None:
    mean, half_width = mean_with_half_width(values)
    moved = mean_with_half_width([value + by for value in values])
    assert moved == (pytest.approx(mean + by, abs=1e-9), pytest.approx(half_width, abs=1e-6))


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
    assert mean_with_half_width(values)[0] == mean


@pytest.mark.parametrize(
    ("values", "half_width"),
    [
        ([HUGE] * 3, 0),
        ([HUGE, -HUGE], math.inf),
        ([HUGE, -HUGE] * 50, pytest.approx(1.98422 / math.sqrt(99) * HUGE, rel=1e-5)),
        ([0.0, 1e290], pytest.approx(12.7062 * 1e290 / 2, rel=1e-5)),
        ([0.0, 0.0, -HUGE, -HUGE], pytest.approx(3.18245 / math.sqrt(12) * HUGE, rel=1e-5)),
    ],
)
def test_an_interval_may_be_of_huge_numbers(values: list[float], half_width: float) -> None:
    assert mean_with_half_width(values)[1] == half_width
