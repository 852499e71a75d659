import contextlib
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.errors import BadValue
from gradysim.scenario.parse.distributions import DISTRIBUTIONS, ParameterStream
from gradysim.scenario.parse.expressions import ParameterContext, differs_between_parameters, parse_value
from gradysim.scenario.parse.units import Quantity, unit_named


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
    "text",
    [
        "parentIndex(1)",
        "ancestorIndex()",
        "ancestorIndex(1.5)",
        "ancestorIndex(1m)",
    ],
)
def test_wrong_calls_for_indices_are_refused(text: str) -> None:
    with pytest.raises(BadValue) as error:
        parse_value(text, ParameterContext(1, "uavs[3].mobility.x"))
    assert error.value.suggestion == error.value.hint == ""


@pytest.mark.parametrize("sign", ["+", "*", "&&", "||", "<", "^", "?"])
def test_chains_of_any_length_end(sign: str) -> None:
    parts = [f" {sign} ".join(["1"] * 5000), f" {sign} ".join(["true"] * 5000)]
    for text in parts:
        with contextlib.suppress(BadValue):
            parse_value(text)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "3 +",
        "fast",
        "index * 3m",
        "0 ^ -1",
        "exp(709) * 10",
        "fmod(5, nan)",
        "3 4",
        "5s 3",
        "5s 3m",
        "3dB 2dB",
        "1dBm + 1dBm",
        "1mW + 1dBm",
        "300m + 5",
        "2s * 3s",
        "2s / 3m",
        "2s / 0",
        "(-1) ^ 0.5",
        "10 ^ 999",
        "2m ^ 2",
        "2 ^ 2m",
        '"a" - "b"',
        "true + 1",
        "1 ? 2 : 3",
        "true ? 2",
        "true ? 1 : fast",
        "!1",
        "1 && true",
        "parentIndex() * 3m",
        "sqrt(4",
        "uniform(0m, 100m)",
        "(1",
        "1)",
        "1; 2",
        "5 parsecs",
        "1e999",
        "1e300 * 1e300",
        "1e300m * 1e300 * inf",
        "1e300s / 1e-300",
        "1e308kW + 1e308GW",
        "100000^64",
        "9" * 5000,
        "(" * 5000,
        "-" * 5000 + "1",
        "(1) + " * 60 + "(" * 51 + "1" + ")" * 51,
    ],
)
def test_wrong_expressions_are_refused(text: str) -> None:
    with pytest.raises(BadValue) as error:
        parse_value(text)
    assert error.value.suggestion == error.value.hint == ""


@pytest.mark.parametrize(
    ("text", "suggestion"),
    [
        ("True", "true"),
        ("10m/s", "mps"),
        ("index() * 3m", "; did you mean `index`, without parentheses?"),
        ("36 km/h", "kmph"),
        ("1ms 2ms", "; a list of values is written `${1ms, 2ms}`"),
        ("1h 5min 3h", "; a list of values is written `${1ms, 2ms}`"),
        ("7.5 % 2", "; for others there is `fmod(a, b)`"),
        ("7 % 2.5", "; for others there is `fmod(a, b)`"),
        ("50%", "; 50% is written `0.5`"),
        ("true and false", "&&"),
        ("1 < 2 and true", "&&"),
        ("true or false", "||"),
        ("not true", "!"),
        ("1 = 2", "=="),
        ("true & false", "&&"),
        ("true | false", "||"),
        ("parentIndex * 3m", "parentIndex()"),
        ("swrt(4)", "sqrt"),
    ],
)
def test_wrong_expressions_get_suggestions(text: str, suggestion: str) -> None:
    with pytest.raises(BadValue) as error:
        parse_value(text)
    assert (error.value.suggestion or error.value.hint) == suggestion


def test_where_no_function_has_a_name_like_that_all_are_named() -> None:
    with pytest.raises(BadValue, match=r"`gamma_d`.* acos,.* weibull$"):
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


LIST = "; a list of values is written `${1ms, 2ms}`"


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("1ms, 2ms", LIST),
        ("1,2", f"{LIST}, a fraction `0.5`"),
        ("{1ms}", LIST),
        ("[1ms]", LIST),
        ("1ms..5ms", "; a range of values is written `${1..5}ms`"),
        ("5s // five", "; a comment begins with `#`"),
        ("$speed", "${speed}"),
        ("$", ""),
        ("1.5.", ""),
        ("3 * / 2", ""),
    ],
)
def test_what_other_grammars_have_there(text: str, hint: str) -> None:
    with pytest.raises(BadValue) as caught:
        parse_value(text)
    assert (caught.value.suggestion or caught.value.hint) == hint


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("10\N{NO-BREAK SPACE}m", "`\N{NO-BREAK SPACE}` (U+00A0, no-break space)"),
        ("\N{MINUS SIGN}10m", "`\N{MINUS SIGN}` (U+2212, minus sign)"),
        (
            "\N{LEFT DOUBLE QUOTATION MARK}a",
            "`\N{LEFT DOUBLE QUOTATION MARK}` (U+201C, left double quotation mark)",
        ),
        ("5 \x91", "`\x91` (U+0091, without a name)"),
        ('5 "\N{MINUS SIGN}"', '`"\N{MINUS SIGN}"`'),
    ],
)
def test_a_character_that_looks_like_another_is_named(text: str, problem: str) -> None:
    with pytest.raises(BadValue) as caught:
        parse_value(text)
    assert caught.value.problem.startswith(f"{problem} ")


@pytest.mark.parametrize("micro", ["\N{MICRO SIGN}", "\N{GREEK SMALL LETTER MU}"])
def test_a_micro_has_a_letter_of_its_own(micro: str) -> None:
    with pytest.raises(BadValue) as caught:
        parse_value(f"100{micro}s")
    assert "`us`" in caught.value.hint


PATH = "uavs[3].wlan[1].radio.transmitter.power"


def test_each_draw_has_a_stream_of_its_own() -> None:
    context = ParameterContext(1, PATH)
    assert not context.has_drawn
    numbers = [context.stream(place).uniform() for place in range(2)]
    assert numbers == [ParameterStream(1, PATH, place).uniform() for place in range(2)]
    assert context.has_drawn


def test_levels_are_counted_from_the_module_of_the_parameter() -> None:
    context = ParameterContext(1, PATH)
    assert context.index_of_ancestor(2) == 1
    assert context.index_of_ancestor(3) == 3


@pytest.mark.parametrize(
    ("path", "levels"),
    [
        ("groundStation.mobility.speed", 1),
    ],
)
def test_missing_indices_are_refused(path: str, levels: int) -> None:
    with pytest.raises(BadValue) as error:
        ParameterContext(1, path).index_of_ancestor(levels)
    assert error.value.suggestion == error.value.hint == ""


@pytest.mark.parametrize(
    ("path", "levels", "suggestion"),
    [
        (PATH, 0, "; that of `uavs[3]` is `ancestorIndex(3)`, that of `wlan[1]` is `ancestorIndex(2)`"),
        (PATH, 4, "; that of `uavs[3]` is `ancestorIndex(3)`, that of `wlan[1]` is `ancestorIndex(2)`"),
        (PATH, -1, "; that of `uavs[3]` is `ancestorIndex(3)`, that of `wlan[1]` is `ancestorIndex(2)`"),
        ("uavs[3].mobility.speed", 0, "; that of `uavs[3]` is `parentIndex()`"),
        ("uavs[3].numWlanInterfaces", 1, "; that of `uavs[3]` is `index`"),
        (
            "uavs[3].wlan[0].radio.channelNumber",
            0,
            "; that of `uavs[3]` is `ancestorIndex(2)`, that of `wlan[0]` is `parentIndex()`",
        ),
    ],
)
def test_missing_indices_get_suggestions(path: str, levels: int, suggestion: str) -> None:
    with pytest.raises(BadValue) as error:
        ParameterContext(1, path).index_of_ancestor(levels)
    assert (error.value.suggestion or error.value.hint) == suggestion


@pytest.mark.parametrize(
    ("text", "differs"),
    [
        ("5m", False),
        ("5m * index", True),
        ("5m * parentIndex()", True),
        ("ancestorIndex (2)", True),
        ('"index parentIndex()"', False),
        ("indexes", False),
        ("max(1, 2)", False),
        *((f"{name}(1, 2)", True) for name in DISTRIBUTIONS),
    ],
)
def test_knows_values_that_differ_between_parameters(text: str, differs: bool) -> None:
    assert differs_between_parameters(text) is differs
