import contextlib
import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.errors import BadValue
from gradysim.scenario.value.expression import parse_value
from gradysim.scenario.value.parameter_context import ParameterContext
from gradysim.scenario.value.quantity import Quantity
from gradysim.scenario.value.units import unit_named


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
        ("-2 ^ 2", (4, None)),
        ("0 - 2 ^ 2", (-4, None)),
        ("2 ^ 3 ^ 2", (512, None)),
        ("7 % 4 * 2", (6, None)),
        ("7 - 5 % 3", (5, None)),
        ("-7 % 3", (-1, None)),
        ("7 % -3", (1, None)),
        ("2 > 1 ? 5s : 3m", (5, "s")),
        ("1 > 2 ? 5s : 3m", (3, "m")),
        ("false ? 1 : true ? 2 : 3", (2, None)),
        ("(true ? false : true) ? 1 : 2", (2, None)),
        ("true ? 1 : 1 / 0 > 2 ? 1 / 0 : 1 / 0", (1, None)),
        ("false ? 1 / 0 : true ? 2 : 1 / 0", (2, None)),
        (" ".join(["false ? 1 :"] * 200) + " 3", (3, None)),
        ("true ? 1 : 1 / 0", (1, None)),
        ("select(1, 1 / 0, 2, 1 / 0)", (2, None)),
        ("false ? 1s + 1m : 2", (2, None)),
        ("max(1s, 200ms) + 1s", (2, "s")),
        ("int(log10(100))", (2, None)),
        ("(10 - 3) * 1dBm", (7, "dBm")),
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


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("true", True),
        ("false", False),
        ("!true == false", True),
        ("true || false && false", True),
        ("1 + 2 == 3 && 2 < 3", True),
        ("1 < 2 == true", True),
        ("false && true == false", False),
        ("true == 1 < 2", True),
        ("true != 1 > 2", True),
        ('true > "a" =~ "b"', True),
        ('"ab" =~ "a" + "?"', True),
        ('"a" + "b" =~ "a?"', True),
        ("true || 1", True),
        ("false && 1", False),
        ("true || 1s < 1m", True),
    ],
)
def test_truth_values(text: str, expected: bool) -> None:
    assert parse_value(text) is expected


def test_texts_are_joined() -> None:
    assert parse_value('"node " + string(3) + "!"') == "node 3!"


def test_a_value_that_is_left_aside_takes_its_draw_all_the_same() -> None:
    def drawn(text: str) -> object:
        return parse_value(text, ParameterContext(1, "uavs[0].protocol.start"))

    assert drawn("false ? uniform(0, 1) : uniform(0, 1)") == drawn("uniform(0, 0) + uniform(0, 1)")


def test_a_value_knows_the_indices_in_the_path_of_its_parameter() -> None:
    value = parse_value(
        "50m * parentIndex() + 1m * ancestorIndex(0 + 1)", ParameterContext(1, "uavs[3].mobility.x")
    )
    assert value == Quantity(153, unit_named("m"))
    assert parse_value("index", ParameterContext(1, "uavs[3].wlan[2].bitrate")) == Quantity(2)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("parentIndex(1)", "`parentIndex()` does not take 1 values"),
        ("ancestorIndex()", "`ancestorIndex(levels)` does not take 0 values"),
        ("ancestorIndex(1.5)", "`ancestorIndex(levels)`: `1.5` is no whole number"),
        ("ancestorIndex(1m)", "`ancestorIndex(levels)`: `1m` is no whole number"),
    ],
)
def test_wrong_calls_for_indices(text: str, message: str) -> None:
    with pytest.raises(BadValue, match=f"^{re.escape(message)}$"):
        parse_value(text, ParameterContext(1, "uavs[3].mobility.x"))


@pytest.mark.parametrize("sign", ["+", "*", "&&", "||", "<", "^", "?"])
def test_chains_of_any_length_end(sign: str) -> None:
    parts = [f" {sign} ".join(["1"] * 5000), f" {sign} ".join(["true"] * 5000)]
    for text in parts:
        with contextlib.suppress(BadValue):
            parse_value(text)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "the value ends too early"),
        ("3 +", "the value ends too early"),
        ("fast", "`fast` is no value (a text stands in quotes)"),
        ("True", "`True` is no value (a text stands in quotes); did you mean `true`?"),
        ("10m/s", "`s` is no value (a text stands in quotes); did you mean `mps`?"),
        ("index * 3m", "this value is the same for all nodes of the line, and knows no index"),
        ("0 ^ -1", "`0` ^ `-1` is no number"),
        ("exp(709) * 10", "the result is too large for a number"),
        ("fmod(5, nan)", "`fmod`: it has no value for `5`, `nan`"),
        ("index() * 3m", "`index` is no function; did you mean `index`, without parentheses?"),
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
        ("10 ^ 999", "the result is too large for a number"),
        ("2m ^ 2", "`2m` ^ `2`: powers are for plain numbers"),
        ("2 ^ 2m", "`2` ^ `2m`: powers are for plain numbers"),
        ('"a" - "b"', 'arithmetic is for numbers only, and `"a"` is none'),
        ("true + 1", "arithmetic is for numbers only, and `true` is none"),
        ("7.5 % 2", "`7.5` % `2`: it is for plain whole numbers; for others there is `fmod(a, b)`"),
        ("7 % 2.5", "`7` % `2.5`: it is for plain whole numbers; for others there is `fmod(a, b)`"),
        ("50%", "the value ends too early; 50% is written `0.5`"),
        ("1 ? 2 : 3", "`?` is for true and false, and `1` is neither"),
        ("true ? 2", "`?` is without its `:`"),
        ("true ? 1 : fast", "`fast` is no value (a text stands in quotes)"),
        ("!1", "`!` is for true and false, and `1` is neither"),
        ("1 && true", "`&&` is for true and false, and `1` is neither"),
        ("true and false", "`and` is not understood there; did you mean `&&`?"),
        ("1 < 2 and true", "`and` is not understood there; did you mean `&&`?"),
        ("true or false", "`or` is not understood there; did you mean `||`?"),
        ("not true", "`not` is not understood there; did you mean `!`?"),
        ("1 = 2", "`=` is not understood there; did you mean `==`?"),
        ("true & false", "`&` is not understood there; did you mean `&&`?"),
        ("true | false", "`|` is not understood there; did you mean `||`?"),
        (
            "parentIndex * 3m",
            "`parentIndex` is no value (a text stands in quotes); did you mean `parentIndex()`?",
        ),
        ("parentIndex() * 3m", "this value is the same for all nodes of the line, and knows no index"),
        ("sqrt(4", "`(` is not closed"),
        ("swrt(4)", "there is no function `swrt`; did you mean `sqrt`?"),
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
        ("(" * 5000, "the expression is nested too deeply; expected at most 50 levels"),
        ("-" * 5000 + "1", "the expression is nested too deeply; expected at most 50 levels"),
        (
            "(1) + " * 60 + "(" * 51 + "1" + ")" * 51,
            "the expression is nested too deeply; expected at most 50 levels",
        ),
    ],
)
def test_errors(text: str, message: str) -> None:
    with pytest.raises(BadValue, match=f"^{re.escape(message)}$"):
        parse_value(text)


def test_where_no_function_has_a_name_like_that_all_are_named() -> None:
    with pytest.raises(BadValue, match=r"^there is no function `gamma_d`; there are acos, .*, weibull$"):
        parse_value("gamma_d(1, 2)")


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
        parse_value("".join(parts), ParameterContext(1, "uavs[0].protocol.start"))
