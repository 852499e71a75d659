import math

import numpy as np
import pytest

from gradysim.protocol.checked_values import checked_number, checked_point, checked_range, is_in_range


class WrongError(Exception):
    pass


def positive(value):
    return checked_number("speed", value, 0, above=True, infinite=True, unit="m/s", error=WrongError)


@pytest.mark.parametrize("value", [1, 0.5, math.inf])
def test_a_number_that_is_accepted_is_returned(value):
    assert positive(value) == value


@pytest.mark.parametrize("value", [0, -1, math.nan, pytest.param(10**400, id="huge"), "5", None, True, 1j])
def test_another_one_is_refused_by_name_and_value(value):
    with pytest.raises(WrongError) as caught:
        positive(value)
    assert str(caught.value) == f"speed must be > 0 m/s, got {value!r}"


@pytest.mark.parametrize(
    ("limits", "expected"),
    [
        ({}, "a finite number"),
        ({"unit": "m"}, "a finite number of m"),
        ({"low": 9}, "finite and >= 9"),
        ({"low": 9, "high": 12}, "from 9 to 12"),
        ({"low": 1, "high": 5, "above": True, "unit": "s"}, "> 1 and <= 5 s"),
    ],
)
def test_the_range_is_named(limits, expected):
    value = 6 if limits and "low" in limits else math.inf
    with pytest.raises(ValueError) as caught:  # noqa: PT011 (the whole text is checked)
        checked_number("speed", value, **limits)
    assert str(caught.value) == f"speed must be {expected}, got {value}"


def test_numbers_of_numpy_are_numbers():
    numpy = pytest.importorskip("numpy")
    assert positive(numpy.float32(2)) == positive(numpy.int64(2)) == 2


def test_what_is_returned_is_a_plain_number():
    numpy = pytest.importorskip("numpy")
    assert type(positive(numpy.float32(2))) is float


@pytest.mark.parametrize("point", [(1, 2, 3), [1.0, 2.0, 3.0], range(1, 4)])
def test_three_finite_numbers_are_a_point(point):
    assert checked_point("home", point, WrongError) == (1.0, 2.0, 3.0)


@pytest.mark.parametrize(
    "point",
    [
        *((1, 2), (1, 2, 3, 4), (1, 2, math.inf), ("a", 2, 3), "123", None, 5),
        pytest.param((1, 2, 10**400), id="huge"),
    ],
)
def test_anything_else_is_refused(point):
    with pytest.raises(WrongError, match=r"^home .*\(x, y, z\)"):
        checked_point("home", point, WrongError)


@pytest.mark.parametrize("limits", [(1, 2), [1.0, 2.0], range(1, 3)])
def test_two_finite_numbers_in_order_are_a_range(limits):
    assert checked_range("width", limits, WrongError) == (1.0, 2.0)


def test_a_range_may_be_a_single_number():
    assert checked_range("width", (3, 3), WrongError) == (3.0, 3.0)


@pytest.mark.parametrize(
    "limits",
    [
        *((2, 1), (1,), (1, 2, 3), (1, math.inf), (math.nan, 2), ("a", 2), "12", None, 5),
        pytest.param((1, 10**400), id="huge"),
    ],
)
def test_what_is_no_range_is_refused(limits):
    with pytest.raises(WrongError, match=r"^width .*\(lowest, highest\)"):
        checked_range("width", limits, WrongError)


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
