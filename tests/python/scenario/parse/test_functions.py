import math
import re
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.errors import BadValue
from gradysim.scenario.parse.expressions import parse_value
from gradysim.scenario.parse.functions import (
    FUNCTIONS,
    OPERATORS,
    QUOTED,
    Value,
    call,
    is_quoted,
    text_of,
    unquoted,
)
from gradysim.scenario.parse.units import Quantity


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ('a "b" c', '"b"'),
        (r'"a \" b" + "c"', r'"a \" b"'),
        (r'"a \\" + "b"', r'"a \\"'),
        ('"two\nlines"', '"two\nlines"'),
        ('""', '""'),
    ],
)
def test_the_first_text_ends_at_its_own_quote(text: str, found: str) -> None:
    match = re.search(QUOTED, text, re.DOTALL)
    assert match is not None
    assert match[0] == found


def test_an_open_quote_is_no_text() -> None:
    assert re.search(QUOTED, r'"a \"', re.DOTALL) is None


@pytest.mark.parametrize("text", ['"a" + "b"', '"a', 'a"', '"', "a", '"a" ', r'"a\"'])
def test_what_is_no_text_alone(text: str) -> None:
    assert not is_quoted(text)


@pytest.mark.parametrize(
    ("written", "text"),
    [('""', ""), (r'"c\"d"', 'c"d'), (r'"\\n"', r"\n"), (r'"a\n\t\rb\c"', "a\n\t\rbc")],
)
def test_the_text_between_the_quotes(written: str, text: str) -> None:
    assert is_quoted(written)
    assert unquoted(written) == text


def result(left: str, sign: str, right: str) -> Value:
    return OPERATORS[sign].apply(parse_value(left), parse_value(right))


@pytest.mark.parametrize(
    ("left", "sign", "right", "expected"),
    [
        ("1s", "<", "1min", True),
        ("5s", "==", "5000ms", True),
        ("0.1", "==", "0.10", True),
        ("10dBm", "==", "10mW", True),
        ("20dBm", ">", "10mW", True),
        ("1km", "<=", "1000m", True),
        ("1km", "!=", "1001m", True),
        ("10 ^ -1", "==", "0.1", True),
        ("0.2 ^ 2", "==", "0.04", True),
        ("sqrt(4) * 0.1", "==", "0.2", True),
        ("sqrt(4) * 0.1s", "<=", "200ms", True),
        ("0.1", "<", "pow(10, -1)", False),
        ("nan", "==", "nan", False),
        ("nan", "!=", "nan", True),
        ('"a"', "<", '"b"', True),
        ('"10"', "<", '"9"', True),
        ("true", ">", "false", True),
        ('"a.b"', "=~", '"a*"', False),
        ('"a.b"', "=~", '"a**"', True),
        ('"ab"', "=~", '"A*"', False),
        ('"uavs[12]"', "=~", '"uavs[10..20]"', True),
    ],
)
def test_comparisons(left: str, sign: str, right: str, expected: bool) -> None:
    assert result(left, sign, right) is expected


@given(st.fractions(), st.fractions())
def test_sums_and_comparisons_are_exact(a: float, b: float) -> None:
    left, right = Quantity(a), Quantity(b)
    total = OPERATORS["+"].apply(left, right)
    assert OPERATORS["=="].apply(OPERATORS["-"].apply(total, right), left) is True


@pytest.mark.parametrize(
    ("left", "sign", "right"),
    [
        ("1s", "<", "1m"),
        ("1s", "==", "1"),
        ("1", "==", '"1"'),
        ("1", "=~", '"1"'),
        ('"1"', "=~", "1"),
        ('"a"', "=~", '"{a"'),
        ("true", "&&", "1"),
        ('"a"', "+", "1"),
        ("5", "%", "0"),
    ],
)
def test_wrong_operands_are_refused(left: str, sign: str, right: str) -> None:
    with pytest.raises(BadValue) as error:
        result(left, sign, right)
    assert error.value.suggestion == error.value.hint == ""


@pytest.mark.parametrize(
    ("left", "sign", "right", "suggestion"),
    [
        ("true", "<", "5", "; several comparisons are joined by `&&`"),
        ("5s", "%", "2", "; for others there is `fmod(a, b)`"),
    ],
)
def test_wrong_operands_get_suggestions(left: str, sign: str, right: str, suggestion: str) -> None:
    with pytest.raises(BadValue) as error:
        result(left, sign, right)
    assert (error.value.suggestion or error.value.hint) == suggestion


@pytest.mark.parametrize("text", ["true", "false", '"a b"', "5", "5s", "0.5m"])
def test_values_are_written_as_they_are_read(text: str) -> None:
    assert text_of(parse_value(text)) == text


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
    "text",
    [
        "sqrt(-1)",
        "log(0)",
        "exp(1000)",
        "pow(-1, 0.5)",
        "fmod(7, 0)",
        "sqrt(16m)",
        "floor(2.5s)",
        "sin(90deg)",
        'sqrt("4")',
        "max(1s, 1)",
        "max(1W, 4000dBm)",
        "max(1, 2, 3)",
        "sqrt()",
        "int(nan)",
        'string("a")',
        "select(3, 1, 2)",
        "select(-1, 1, 2)",
        "select(0.5, 1, 2)",
        "select(1)",
        "choose(1, 2)",
    ],
)
def test_wrong_arguments_are_refused(text: str) -> None:
    with pytest.raises(BadValue) as error:
        parse_value(text)
    assert error.value.suggestion == error.value.hint == ""


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_function_says_how_it_is_written(name: str) -> None:
    written, _ = FUNCTIONS[name]
    assert written.startswith(f"{name}(")
    with pytest.raises(BadValue):
        call(name, [])
