import math

import pytest
from hypothesis import given
from hypothesis.strategies import floats

from gradysim.protocol.readable_number import readable_number


@pytest.mark.parametrize(
    ("number", "readable"),
    [
        (59.90000000000058, 59.9),
        (60.00000000000058, 60.0),
        (0.1 + 0.2, 0.3),
        (-0.30000000000000004, -0.3),
        (1e-17, 1e-17),
        (5.0, 5.0),
        (1234567890123456.0, 1234567890123456.0),
        (math.inf, math.inf),
        (-math.inf, -math.inf),
    ],
)
def test_what_rounding_has_left_is_gone(number, readable):
    assert readable_number(number) == readable


def test_what_is_no_number_stays_that():
    assert math.isnan(readable_number(math.nan))


@given(floats(allow_nan=False, allow_infinity=False))
def test_nothing_changes_by_more_than_the_twelfth_digit(number):
    assert readable_number(number) == pytest.approx(number, rel=5.1e-12, abs=0)
    assert readable_number(readable_number(number)) == readable_number(number)
