import math
from decimal import Decimal
from enum import IntEnum
from fractions import Fraction

import numpy
import pytest

from gradysim.protocol.number import as_float


class Level(IntEnum):
    HIGH = 3


class Spoilt(float):
    def __float__(self):
        raise ArithmeticError("spoilt")


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (5, 5.0),
        (0.25, 0.25),
        (True, 1.0),
        (math.inf, math.inf),
        (Fraction(1, 4), 0.25),
        (Level.HIGH, 3.0),
        (numpy.float32(0.5), 0.5),
        (numpy.int64(7), 7.0),
        (numpy.bool_(True), 1.0),
        (numpy.array([8]), 8.0),
    ],
)
def test_numbers(value, expected):
    number = as_float(value)
    assert (type(number), number) == (float, expected)


def test_nan_is_a_number():
    assert math.isnan(as_float(math.nan))


@pytest.mark.parametrize(
    "value", ["5", None, [5], {}, 5j, Decimal(5), 10**400, numpy.array([1, 2]), Spoilt(1), object()]
)
def test_what_is_none_or_too_large_for_a_float(value):
    assert as_float(value) is None
