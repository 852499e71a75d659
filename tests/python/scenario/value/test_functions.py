import math
import re
from fractions import Fraction

import pytest

from gradysim.scenario.errors import BadValue
from gradysim.scenario.value.expression import parse_value
from gradysim.scenario.value.functions import FUNCTIONS, call
from gradysim.scenario.value.operators import text_of
from gradysim.scenario.value.quantity import Quantity


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("floor(2.7)", 2),
        ("floor(-2.5)", -3),
        ("ceil(2.2)", 3),
        ("floor(inf)", math.inf),
        ("fabs(-3)", 3),
        ("sqrt(16)", 4),
        ("exp(0)", 1),
        ("log(1)", 0),
        ("log10(1000)", 3),
        ("sin(0) + cos(0) + tan(0)", 1),
        ("acos(1) + asin(0) + atan(0)", 0),
        ("atan2(1, 1)", math.pi / 4),
        ("hypot(3, 4)", 5),
        ("pow(2, 3)", 8),
        ("fmod(7, 2.5)", 2),
        ("fmod(-7, 2.5)", -2),
        ("fmod(7, inf)", 7),
        ("max(2, 2.5)", 2.5),
        ("min(2, 2.5)", 2),
        ("int(-2.5)", -3),
        ("int(true)", 1),
        ("select(1, 10, 20, 30)", 20),
    ],
)
def test_numbers(text: str, expected: float) -> None:
    value = parse_value(text)
    assert isinstance(value, Quantity)
    assert float(value.number) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("max(3s, 2000ms)", "3s"),
        ("min(3s, 2000ms)", "2000ms"),
        ("max(10dBm, 20mW)", "20mW"),
        ("max(1as, 1e308d)", "1e+308d"),
        ("fmod(3as, 1e308d)", "3.0as"),
        ("fabs(-3m)", "3m"),
        ("fmod(7s, 2000ms)", "1.0s"),
        ("int(2.7s)", "2s"),
        ("select(0, 5m, 1s)", "5m"),
        ("string(3)", '"3"'),
        ("string(2.5s)", '"2.5s"'),
        ("string(1/3)", '"0.333333"'),
        ("string(1 < 2)", '"true"'),
        ('choose(1, "a b  c")', '"b"'),
    ],
)
def test_quantities_and_texts(text: str, expected: str) -> None:
    assert text_of(parse_value(text)) == expected


@pytest.mark.parametrize(
    ("text", "is_whole"),
    [
        ("int(6 / 2)", True),
        ("floor(2.5)", False),
        ("ceil(2)", False),
        ("double(3)", False),
        ("max(1, 2)", True),
    ],
)
def test_only_int_makes_whole_numbers(text: str, is_whole: bool) -> None:
    value = parse_value(text)
    assert isinstance(value, Quantity)
    assert isinstance(value.number, int) is is_whole


def test_the_remainder_is_exact() -> None:
    value = parse_value("fmod(1km, 0.3mm)")
    assert isinstance(value, Quantity)
    assert value.number == Fraction(1, 10**7)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("sqrt(-1)", "`sqrt`: it has no value for `-1`"),
        ("log(0)", "`log`: it has no value for `0`"),
        ("exp(1000)", "`exp`: it has no value for `1000`"),
        ("pow(-1, 0.5)", "`pow`: it has no value for `-1`, `0.5`"),
        ("fmod(7, 0)", "`fmod`: it has no value for `7`, `0`"),
        ("sqrt(16m)", "`sqrt`: `16m` is no plain number"),
        ("floor(2.5s)", "`floor`: `2.5s` is no plain number"),
        ("sin(90deg)", "`sin`: `90deg` is no plain number"),
        ('sqrt("4")', '`sqrt`: arithmetic is for numbers only, and `"4"` is none'),
        ("max(1s, 1)", "`max`: `1s` and `1` measure different things and cannot be compared"),
        ("max(1W, 4000dBm)", "`max`: `4000dBm` is too large for a number"),
        ("max(1, 2, 3)", "`max(a, b)` does not take 3 values"),
        ("sqrt()", "`sqrt(x)` does not take 0 values"),
        ("int(nan)", "`int`: `nan` is no whole number"),
        ('string("a")', '`string`: `"a"` is a text already'),
        ("select(3, 1, 2)", "`select`: there is no item 3, only 0 to 1"),
        ("select(-1, 1, 2)", "`select`: there is no item -1, only 0 to 1"),
        ("select(0.5, 1, 2)", "`select`: `0.5` is no whole number"),
        ("select(1)", "`select(index, a, b, ...)` does not take 1 values"),
        ("choose(1, 2)", "`choose`: `2` is no text"),
    ],
)
def test_refused(text: str, message: str) -> None:
    with pytest.raises(BadValue, match=f"^{re.escape(message)}$"):
        parse_value(text)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_function_says_how_it_is_written(name: str) -> None:
    with pytest.raises(BadValue, match=rf"^`{name}\(.+\)` does not take 0 values$"):
        call(name, [])
