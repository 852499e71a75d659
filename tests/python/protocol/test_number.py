import math
from decimal import Decimal
from enum import IntEnum
from fractions import Fraction

import numpy
import pytest

from gradysim.protocol.number import as_float
from gradysim.protocol.plain_value import plain_value


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
        (numpy.array(8), 8.0),
        (numpy.float64(9), 9.0),
    ],
)
def test_numbers(value, expected):
    number = as_float(value)
    assert (type(number), number) == (float, expected)


def test_nan_is_a_number():
    assert math.isnan(as_float(math.nan))


@pytest.mark.parametrize(
    "value",
    [
        *("5", None, [5], {}, 5j, Decimal(5), 10**400, Spoilt(1), object()),
        *(numpy.array([5]), numpy.array([[5]]), numpy.array([1, 2]), numpy.array("5"), numpy.str_("5")),
        *(numpy.complex64(5), numpy.array(None), numpy.datetime64("2026-11-23")),
    ],
)
def test_what_is_none_or_too_large_for_a_float(value):
    assert as_float(value) is None


@pytest.mark.parametrize(
    "value",
    [
        *(numpy.array([5]), numpy.array(5), numpy.array(True), numpy.float64(5), numpy.int32(5)),
        *(numpy.bool_(True), numpy.uint8(5), numpy.float16(0.5), numpy.longdouble(0.5), numpy.array("5")),
        *(numpy.datetime64("2026-11-23"), numpy.timedelta64(5, "ns"), numpy.array([])),
        *(5, 0.5, True, None, "5", [5], (5,), Level.HIGH, Fraction(1, 4), Decimal(5), 5j),
    ],
    ids=lambda value: f"{type(value).__name__} {value}",
)
def test_a_number_is_what_json_has_as_a_number(value):
    plain = plain_value(value)
    assert as_float(value) == (plain if isinstance(plain, int | float) else None)
