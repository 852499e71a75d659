import enum
import json
import math
import os
import re
import subprocess
import sys
from decimal import Decimal
from enum import IntEnum
from fractions import Fraction

import numpy
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.plain_value import as_float, plain_value, readable_number
from python.any_value import anything


@given(anything)
def test_every_value_becomes_strict_json(value):
    json.dumps(plain_value(value), allow_nan=False)


@given(
    st.recursive(
        st.none()
        | st.booleans()
        | st.integers()
        | st.floats(allow_nan=False, allow_infinity=False)
        | st.text(),
        lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
        max_leaves=20,
    )
)
def test_a_plain_value_stays_what_it_is(value):
    assert plain_value(value) == value


@pytest.mark.parametrize("number", [math.inf, -math.inf])
def test_an_infinity_is_given_as_text(number):
    assert plain_value(number) == repr(number)


@pytest.mark.parametrize("items", [range(20), ["b", "a", 10, 9], [frozenset("ab"), frozenset()]])
@pytest.mark.parametrize("kind", [set, frozenset])
def test_a_set_is_given_as_text_that_is_python(kind, items):
    assert eval(plain_value(kind(items))) == kind(items)


@pytest.mark.parametrize("kind", [set, frozenset])
def test_an_empty_set_is_given_as_text(kind):
    assert plain_value(kind()) == repr(kind())


def test_the_text_of_a_set_does_not_depend_on_the_process():
    code = "from gradysim.protocol.plain_value import plain_value; print(plain_value([{'b', 'aa', 'c', 3}]))"
    texts = {
        subprocess.run(
            [sys.executable, "-c", code],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
        ).stdout
        for seed in ("1", "2", "3")
    }
    assert len(texts) == 1


def test_a_fraction_too_large_for_a_float_is_given_as_text():
    assert plain_value(Fraction(10**400, 3)).startswith("Fraction(1000")


def test_nan_becomes_none():
    np = pytest.importorskip("numpy")
    assert plain_value(
        {"level": math.nan, "levels": np.array([1.0, np.nan]), "small": np.float32("nan")}
    ) == {
        "level": None,
        "levels": [1.0, None],
        "small": None,
    }


def test_the_value_for_nan_can_be_chosen():
    assert plain_value([math.nan, {"level": math.nan}], nan="nan") == ["nan", {"level": "nan"}]


@pytest.mark.parametrize("sign", [1, -1])
def test_an_integer_too_long_for_decimal_digits_is_given_as_hexadecimal(sign):
    number = sign * 2**20_000
    shown = json.loads(json.dumps(plain_value({"count": number})))
    assert int(shown["count"], 16) == number


def test_numpy_numbers_and_arrays_become_pythons():
    np = pytest.importorskip("numpy")
    value = {
        "count": np.int64(3),
        "mean": np.float32(0.5),
        "done": np.bool_(True),
        "path": np.array([1.0, 2.0]),
    }
    assert plain_value(value) == {"count": 3, "mean": 0.5, "done": True, "path": [1.0, 2.0]}


def test_a_member_of_a_text_enumeration_is_its_value():
    class Status(str, enum.Enum):  # noqa: UP042 - StrEnum would hide what is tested
        IDLE = "idle"

    assert plain_value([Status.IDLE]) == ["idle"]


def test_a_key_that_is_no_text_is_given_as_repr():
    assert plain_value({(1, 2): 0, 3: 0}) == {"(1, 2)": 0, "3": 0}


def test_a_container_inside_itself_ends():
    knot: list[object] = [1]
    knot.append(knot)
    assert plain_value(knot) == [1, "[1, [...]]"]


def test_the_same_container_twice_is_not_a_cycle():
    inner = [1]
    assert plain_value([inner, inner]) == [[1], [1]]


@pytest.mark.parametrize("wrap", [lambda inner: [inner], lambda inner: {"next": inner}])
def test_the_depths_of_a_deep_structure_are_left_out(wrap):
    value = "bottom"
    for _ in range(100_000):
        value = wrap(value)
    shown = json.dumps(plain_value(value))
    assert shown.count("[") + shown.count("{") == 100


def test_a_number_whose_conversion_fails_is_given_as_text():
    class Broken(float):
        def __float__(self):
            raise RuntimeError

    assert plain_value([Broken(1.5), 2]) == ["1.5", 2]


def test_an_object_whose_repr_fails_is_named_by_its_class():
    class Broken:
        def __repr__(self):
            raise RuntimeError

    assert re.search("Broken .* 0x", str(plain_value(Broken())))


class Level(IntEnum):
    HIGH = 3


class Broken(float):
    def __float__(self):
        raise ArithmeticError("broken")


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
        *("5", None, [5], {}, 5j, Decimal(5), 10**400, Broken(1), object()),
        *(numpy.array([5]), numpy.array([[5]]), numpy.array([1, 2]), numpy.array("5"), numpy.str_("5")),
        *(numpy.complex64(5), numpy.array(None), numpy.datetime64("2026-11-23")),
    ],
)
def test_other_values_are_not_numbers(value):
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
def test_rounding_errors_are_removed(number, readable):
    assert readable_number(number) == readable


def test_nan_stays_nan():
    assert math.isnan(readable_number(math.nan))


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_nothing_changes_by_more_than_the_twelfth_digit(number):
    assert readable_number(number) == pytest.approx(number, rel=5.1e-12, abs=0)
    assert readable_number(readable_number(number)) == readable_number(number)
