import math

import pytest

from gradysim.protocol.plugin.checked_values import checked_number, checked_point


class WrongError(Exception):
    pass


def positive(value):
    return checked_number("speed", value, lambda number: number > 0, "> 0 m/s", WrongError)


@pytest.mark.parametrize("value", [1, 0.5, math.inf])
def test_a_number_that_is_accepted_is_returned(value):
    assert positive(value) == value


@pytest.mark.parametrize("value", [0, -1, math.nan, pytest.param(10**400, id="huge"), "5", None, True, 1j])
def test_another_one_is_refused_by_name_and_value(value):
    with pytest.raises(WrongError) as caught:
        positive(value)
    assert str(caught.value) == f"speed must be > 0 m/s, got {value!r}"


def test_numbers_of_numpy_are_numbers():
    numpy = pytest.importorskip("numpy")
    assert positive(numpy.float32(2)) == positive(numpy.int64(2)) == 2


@pytest.mark.parametrize("point", [(1, 2, 3), [1.0, 2.0, 3.0], range(1, 4)])
def test_three_finite_numbers_are_a_point(point):
    assert checked_point("home", point, WrongError) == (1.0, 2.0, 3.0)


@pytest.mark.parametrize("point", [(1, 2), (1, 2, 3, 4), (1, 2, math.inf), ("a", 2, 3), "123", None, 5])
def test_anything_else_is_refused(point):
    with pytest.raises(WrongError, match=r"home must be three finite numbers \(x, y, z\) in metres, got"):
        checked_point("home", point, WrongError)
