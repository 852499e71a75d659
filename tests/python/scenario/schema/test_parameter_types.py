import math

import pytest

from gradysim.scenario.errors import BadValue
from gradysim.scenario.parse.expressions import parse_value
from gradysim.scenario.schema.parameter_types import (
    ParameterType,
    boolean,
    choice,
    integer,
    number,
    number_in,
    power_ratio,
    quantity,
    si_number,
    text,
    whole_bytes,
)


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("WaypointMobility", "; here it is otherwise"),
        ("MaslessMobility", "MasslessMobility"),
    ],
)
def test_what_other_simulators_have_is_told_from_what_is_misspelt(name: str, hint: str) -> None:
    kind = choice("MasslessMobility", "StationaryMobility", otherwise="here it is otherwise")
    with pytest.raises(BadValue) as caught:
        kind.convert(name)
    assert (caught.value.suggestion or caught.value.hint) == hint


@pytest.mark.parametrize(
    ("kind", "written", "expected"),
    [
        (quantity("s"), "100ms", 0.1),
        (quantity("W"), "-100dBm", 1e-13),
        (quantity("bps", above=0, special=-1), "-1bps", -1.0),
        (quantity("m", at_least=0), "0m", 0.0),
        (quantity("deg", at_most=90), "90deg", 90.0),
        (number(), "2", 2.0),
        (number(), "2x", 2.0),
        (integer(), "7", 7),
        (integer(), "2147483647", 2147483647),
        (integer(at_most=None), "99999999999999999999", 99999999999999999999),
        (whole_bytes(), "2304B", 2304),
        (whole_bytes(), "1KiB", 1024),
        (power_ratio(), "4dB", 10**0.4),
        (power_ratio(), "10dB", 10.0),
        (boolean(), "true", True),
        (text(), '"x"', "x"),
        (choice("b", "a"), '"a"', "a"),
        (si_number(), "100ms", 0.1),
        (si_number(), "3", 3.0),
        (number_in("ms"), "2s", 2000.0),
        (number_in("ms"), "2", 2.0),
        (number_in("deg"), "90deg", 90.0),
        (si_number(), "36kmph", 10.0),
        (si_number(), "20dBm", 0.1),
        (si_number(), "180deg", math.pi),
        (si_number(), "4dB", 4.0),
        (si_number(), "inf", math.inf),
    ],
)
def test_converts(kind: ParameterType, written: str, expected: object) -> None:
    result = kind.convert(parse_value(written))
    assert result == pytest.approx(expected, rel=1e-15) if isinstance(expected, float) else result == expected
    assert type(result) is type(expected)


@pytest.mark.parametrize(
    ("kind", "written"),
    [
        (quantity("s"), "3"),
        (quantity("s"), "true"),
        (quantity("s"), "nan s"),
        (quantity("s"), "inf s"),
        (quantity("m", at_least=0), "-1m"),
        (quantity("m", above=0), "0m"),
        (quantity("deg", at_most=90), "91deg"),
        (number(), "nan"),
        (number(), "2m"),
        (integer(), "2.5"),
        (integer(), "inf"),
        (integer(), "2147483648"),
        (integer(1), "0"),
        (whole_bytes(), "3b"),
        (power_ratio(), "4"),
        (boolean(), "1"),
        (boolean(), '"true"'),
        (text(), "3m"),
        (si_number(), "nan"),
        (number_in("s"), "nan"),
        (number_in("s"), "5m"),
        (number_in("s"), "true"),
        (si_number(), "3B"),
    ],
)
def test_wrong_values_are_refused(kind: ParameterType, written: str) -> None:
    with pytest.raises(BadValue) as error:
        kind.convert(parse_value(written))
    assert error.value.suggestion == error.value.hint == ""


@pytest.mark.parametrize(
    ("kind", "written", "suggestion"),
    [
        (integer(), "2.0", "; did you mean `2`, or `int(...)` of an expression?"),
        (integer(), "1e3", "; did you mean `1000`, or `int(...)` of an expression?"),
        (choice("b", "g(erp)"), '"g(erp"', "g(erp)"),
    ],
)
def test_wrong_values_get_suggestions(kind: ParameterType, written: str, suggestion: str) -> None:
    with pytest.raises(BadValue) as error:
        kind.convert(parse_value(written))
    assert (error.value.suggestion or error.value.hint) == suggestion


@pytest.mark.parametrize(
    ("kind", "expected"),
    [
        (quantity("mps", at_least=0), "a speed such as 10mps, at least 0mps"),
        (
            quantity("bps", above=0, special=-1),
            "a bitrate such as 24Mbps, greater than 0bps, or -1bps",
        ),
        (
            quantity("deg", at_least=-90, at_most=90),
            "an angle such as 90deg, at least -90deg and at most 90deg",
        ),
        (integer(1), "an integer, at least 1"),
        (integer(at_most=None), "an integer"),
        (choice("b", "a"), 'one of "b", "a"'),
        (choice("b"), '"b"'),
        (number_in("s"), "a time such as 10s, or a number of s"),
    ],
)
def test_says_what_it_expects(kind: ParameterType, expected: str) -> None:
    assert kind.expected == expected
