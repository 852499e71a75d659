import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.errors import BadValue
from gradysim.scenario.value.expression import parse_value
from gradysim.scenario.value.operators import OPERATORS, Value, text_of
from gradysim.scenario.value.quantity import Quantity


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
    ("left", "sign", "right", "message"),
    [
        ("1s", "<", "1m", "`1s` and `1m` measure different things and cannot be compared"),
        ("1s", "==", "1", "`1s` and `1` measure different things and cannot be compared"),
        ("1", "==", '"1"', '`1` and `"1"` cannot be compared'),
        ("true", "<", "5", "`true` and `5` cannot be compared; several comparisons are joined by `&&`"),
        ("1", "=~", '"1"', "`=~` is for a text and a pattern, both in quotes"),
        ('"1"', "=~", "1", "`=~` is for a text and a pattern, both in quotes"),
        ('"a"', "=~", '"{a"', "`{` is not closed; expected `}` after it (a plain brace is written `\\{`)"),
        ("true", "&&", "1", "`&&` is for true and false, and `1` is neither"),
        ('"a"', "+", "1", 'arithmetic is for numbers only, and `"a"` is none'),
        ("5", "%", "0", "`5` is divided by zero"),
        ("5s", "%", "2", "`5s` % `2`: it is for plain whole numbers; for others there is `fmod(a, b)`"),
    ],
)
def test_refused(left: str, sign: str, right: str, message: str) -> None:
    with pytest.raises(BadValue, match=f"^{re.escape(message)}$"):
        result(left, sign, right)


@pytest.mark.parametrize("text", ["true", "false", '"a b"', "5", "5s", "0.5m"])
def test_values_are_written_as_they_are_read(text: str) -> None:
    assert text_of(parse_value(text)) == text
