import math

import numpy as np
import pytest

from gradysim.protocol.checked_values import is_in_range


@pytest.mark.parametrize("value", [0, 0.0, 1, 1e300, np.float64(2), np.int64(3)])
def test_finite_numbers_from_the_limit_on_are_right(value):
    assert is_in_range(value, 0)


@pytest.mark.parametrize(
    "value",
    [-1, -1e-300, math.nan, math.inf, -math.inf, pytest.param(10**400, id="huge"), True, None, "1", [1], 1j],
)
def test_anything_else_is_wrong(value):
    assert not is_in_range(value, 0)


@pytest.mark.parametrize(("value", "right"), [(0, True), (1, True), (1.0001, False)])
def test_the_upper_limit_is_right_too(value, right):
    assert is_in_range(value, 0, 1) is right


@pytest.mark.parametrize(("value", "right"), [(0, False), (1e-300, True)])
def test_above_the_limit(value, right):
    assert is_in_range(value, 0, above=True) is right


@pytest.mark.parametrize(("value", "right"), [(-math.inf, False), (-1e300, True), (math.inf, False)])
def test_any_finite_number(value, right):
    assert is_in_range(value, -math.inf, above=True) is right
