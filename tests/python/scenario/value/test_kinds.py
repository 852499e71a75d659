import math
import re

import pytest

from gradysim.scenario.errors import BadValue
from gradysim.scenario.value.expression import parse_value
from gradysim.scenario.value.kinds import (
    Kind,
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
    ("name", "suggestion", "hint"),
    [
        ("WaypointMobility", "", "; here it is otherwise"),
        ("MaslessMobility", "MasslessMobility", ""),
    ],
)
def test_names_of_other_simulators_are_not_typing_errors(name: str, suggestion: str, hint: str) -> None:
    kind = choice("MasslessMobility", "StationaryMobility", otherwise="here it is otherwise")
    with pytest.raises(BadValue) as caught:
        kind.convert(name)
    assert (caught.value.suggestion, caught.value.hint) == (suggestion, hint)


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
def test_converts(kind: Kind, written: str, expected: object) -> None:
    result = kind.convert(parse_value(written))
    assert result == pytest.approx(expected, rel=1e-15) if isinstance(expected, float) else result == expected
    assert type(result) is type(expected)


@pytest.mark.parametrize(
    ("kind", "written", "problem"),
    [
        (quantity("s"), "3", "`3` has no unit"),
        (quantity("s"), "true", "it is a truth value"),
        (quantity("s"), "nan s", "`nans` is not finite"),
        (quantity("s"), "inf s", "`infs` is not finite"),
        (quantity("m", at_least=0), "-1m", "it is out of range"),
        (quantity("m", above=0), "0m", "it is out of range"),
        (quantity("deg", at_most=90), "91deg", "it is out of range"),
        (number(), "nan", "`nan` is not finite"),
        (number(), "2m", "it has the unit `m`"),
        (
            integer(),
            "2.0",
            "it is a floating-point number; did you mean `2`, or `int(...)` of an expression?",
        ),
        (
            integer(),
            "1e3",
            "it is a floating-point number; did you mean `1000`, or `int(...)` of an expression?",
        ),
        (integer(), "2.5", "`2.5` is no whole number"),
        (integer(), "inf", "`inf` is no whole number"),
        (integer(), "2147483648", "it is out of range"),
        (integer(1), "0", "it is out of range"),
        (whole_bytes(), "3b", "`3b` is no whole number of bytes"),
        (power_ratio(), "4", "`4` has no unit"),
        (boolean(), "1", "it is a number"),
        (boolean(), '"true"', "it is a text"),
        (text(), "3m", "it is a quantity"),
        (
            choice("b", "g(erp)"),
            '"g(erp"',
            "`g(erp` is not known; did you mean `g(erp)`?",
        ),
        (si_number(), "nan", "`nan` is no number"),
        (number_in("s"), "nan", "`nan` is no number"),
        (number_in("s"), "5m", "`m` is the unit of a length; `m` is metres, a minute is `min`"),
        (number_in("s"), "true", "it is a truth value"),
        (si_number(), "3B", "bits and bytes have no SI unit"),
    ],
)
def test_refuses(kind: Kind, written: str, problem: str) -> None:
    with pytest.raises(BadValue, match=f"^{re.escape(problem)}$"):
        kind.convert(parse_value(written))


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
        (integer(1), "a whole number, at least 1"),
        (integer(at_most=None), "a whole number"),
        (choice("b", "a"), 'one of "b", "a"'),
        (choice("b"), '"b"'),
        (number_in("s"), "a time such as 10s, or a number of s"),
    ],
)
def test_says_what_it_expects(kind: Kind, expected: str) -> None:
    assert kind.expected == expected
