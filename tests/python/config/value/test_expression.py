import contextlib
import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.config.errors.config_error import BadValue
from gradysim.config.value.expression import parse_value
from gradysim.config.value.parameter_stream import ParameterDraws
from gradysim.config.value.quantity import Quantity


def number_and_unit(text: str) -> tuple[float, str | None]:
    value = parse_value(text)
    assert isinstance(value, Quantity)
    return float(value.number), value.unit.name if value.unit else None


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("5", (5, None)),
        ("-5", (-5, None)),
        ("1e3", (1000, None)),
        ("1.e3m", (1000, "m")),
        (".5s", (0.5, "s")),
        ("20 mW", (20, "mW")),
        ("-85dBm", (-85, "dBm")),
        ("1h 5min", (1 + 5 / 60, "h")),
        ("1h5min", (1 + 5 / 60, "h")),
        ("1h\n5min", (1 + 5 / 60, "h")),
        ("2 * 50m", (100, "m")),
        ("50m * 2", (100, "m")),
        ("100m / 4", (25, "m")),
        ("1km / 200m", (5, None)),
        ("1km - 200m", (0.8, "km")),
        ("1 + 2 * 3", (7, None)),
        ("(1 + 2) * 3", (9, None)),
        ("8 - 4 - 2", (2, None)),
        ("-2 ^ 2", (-4, None)),
        ("2 ^ -1", (0.5, None)),
        ("2 ^ 10", (1024, None)),
        ("-(3m)", (-3, "m")),
        ("inf", (math.inf, None)),
        ("-inf s", (-math.inf, "s")),
        ("1e-500", (0, None)),
    ],
)
def test_numbers(text: str, expected: tuple[float, str | None]) -> None:
    assert number_and_unit(text) == expected


def test_nan_is_a_number_here() -> None:
    assert math.isnan(number_and_unit("nan")[0])


@pytest.mark.parametrize(
    ("text", "is_integer"),
    [
        ("3", True),
        ("3.0", False),
        ("3e0", False),
        ("2 + 1", True),
        ("6 / 2", False),
        ("2^3", True),
    ],
)
def test_tells_integers_from_other_numbers(text: str, is_integer: bool) -> None:
    value = parse_value(text)
    assert isinstance(value, Quantity)
    assert isinstance(value.number, int) is is_integer


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('""', ""),
        ('"g(mixed)"', "g(mixed)"),
        (r'"a \"b\" \\ \n"', 'a "b" \\ \n'),
        ('"${x} # ; = "', "${x} # ; = "),
    ],
)
def test_texts(text: str, expected: str) -> None:
    assert parse_value(text) == expected


@given(st.text())
def test_any_text_can_be_written(text: str) -> None:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    assert parse_value(f'"{escaped}"') == text


def test_truth_values() -> None:
    assert parse_value("true") is True
    assert parse_value("false") is False


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "the value ends too early"),
        ("3 +", "the value ends too early"),
        ("fast", "`fast` is no value (a text stands in quotes)"),
        ("True", "`True` is no value (a text stands in quotes); did you mean `true`?"),
        ("10m/s", "`s` is no value (a text stands in quotes); did you mean `mps`?"),
        (
            "index * 3m",
            "`index` is no value (a text stands in quotes); no value knows the index of a node:"
            " `lineStepX = 3m` sets nodes in a line",
        ),
        ("36 km/h", "`h` is no value (a text stands in quotes); did you mean `kmph`?"),
        ("3 4", "`4` follows `3`; only quantities with units may be strung together"),
        ("5s 3", "`3` follows `5s`; only quantities with units may be strung together"),
        ("5s 3m", "`5s` and `3m` measure different things and cannot be added"),
        (
            "1ms 2ms",
            "`2ms` follows another number of `ms`; a list of values is written `${1ms, 2ms}`",
        ),
        ("1h 5min 3h", "`3h` follows another number of `h`; a list of values is written `${1ms, 2ms}`"),
        ("3dB 2dB", "`2dB` follows `3dB`; decibels cannot be strung together"),
        ("1dBm + 1dBm", "`1dBm` and `1dBm` cannot be added, they are logarithms"),
        ("1mW + 1dBm", "`1mW` and `1dBm` cannot be added, one is a logarithm"),
        ("300m + 5", "`300m` and `5` measure different things and cannot be added"),
        ("2s * 3s", "`2s` times `3s` has no unit here"),
        ("2s / 3m", "`2s` divided by `3m` has no unit here"),
        ("2s / 0", "`2s` is divided by zero"),
        ("(-1) ^ 0.5", "`-1` ^ `0.5` is no number"),
        ("10 ^ 999", "`10` ^ `999` is no number"),
        ("2m ^ 2", "`2m` ^ `2`: powers are for plain numbers"),
        ('"a" + "b"', "arithmetic is for numbers only"),
        (
            "uniform(0m, 100m)",
            "`uniform` draws the value of a parameter, which this is not",
        ),
        ("(1", "`(` is not closed"),
        ("1)", "`)` is not understood there"),
        ("1; 2", "`;` is not understood there"),
        ("5 parsecs", "there is no unit `parsecs`"),
        ("1e999", "`1e999...` is too large a number"),
        ("1e300 * 1e300", "the result is too large for a number"),
        ("1e300m * 1e300 * inf", "the result is too large for a number"),
        ("1e300s / 1e-300", "the result is too large for a number"),
        ("1e308kW + 1e308GW", "the result is too large for a number"),
        ("100000^64", "the result is too large for a number"),
        ("9" * 5000, "`99999999999999999999...` is too large a number"),
        ("(" * 5000, "the expression is nested too deeply"),
        ("-" * 5000 + "1", "the expression is nested too deeply"),
    ],
)
def test_errors(text: str, message: str) -> None:
    with pytest.raises(BadValue, match=f"^{re.escape(message)}$"):
        parse_value(text)


@given(st.text('0123456789.eE+-*/^(), smWdB"xy', max_size=12))
def test_no_text_fails_in_any_other_way(text: str) -> None:
    with contextlib.suppress(BadValue):
        parse_value(text)


@given(
    st.lists(
        st.sampled_from(
            ["uniform(", "normal(", "intuniform(", "exponential(", "1", "2m", "inf", ",", ")", "-"]
        )
    )
)
def test_no_call_fails_in_any_other_way(parts: list[str]) -> None:
    with contextlib.suppress(BadValue):
        parse_value("".join(parts), ParameterDraws(1, "uavs[0].protocol.start"))
