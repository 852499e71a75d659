import math
from typing import Annotated, ClassVar, Final

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.errors.config_error import BadValue
from gradysim.scenario.expressions import parse_value
from gradysim.scenario.protocol.parameters import parameters_of


class Base(IProtocol):
    inherited = 1
    replaced = 1
    hidden = 1


class Mobile(Base):
    real = 0.5
    real_by_annotation: float = 0
    real_by_text: "float | None" = 0
    real_constant: ClassVar[float] = 0
    interval: Annotated[float, "min"] = 5
    timeout_ms = 20.0
    power_w = 0.1
    power_mw = 100.0
    power_dbm = 20.0
    power_dbw = -10.0
    lost_db = 3.0
    whole: int = 3
    period_ms: int = 100
    heading_deg = 0.0
    heading_rad = 0.0
    text: Final = "x"
    flag = False
    register = 1  # the name of a method of all abstract classes, but of no protocol
    replaced = "now a text"  # type: ignore[assignment]
    hidden = None  # type: ignore[assignment]
    _private = 1
    waypoints: ClassVar[list[int]] = [1]
    annotated_only: float
    initialize = 3  # type: ignore[assignment]

    @property
    def derived(self) -> float:
        return 1.0

    def method(self) -> None: ...


def converted(name: str, written: str) -> object:
    return parameters_of(Mobile)[name].convert(parse_value(written))


def test_are_public_plain_class_attributes() -> None:
    assert set(parameters_of(Mobile)) == {
        "inherited",
        "replaced",
        "real",
        "real_by_annotation",
        "real_by_text",
        "real_constant",
        "interval",
        "timeout_ms",
        "power_w",
        "power_mw",
        "power_dbm",
        "power_dbw",
        "lost_db",
        "whole",
        "period_ms",
        "heading_deg",
        "heading_rad",
        "text",
        "flag",
        "register",
    }


@pytest.mark.parametrize("name", ["real", "real_by_annotation", "real_by_text", "real_constant"])
def test_floats_take_quantities_and_whole_numbers(name: str) -> None:
    assert converted(name, "100ms") == 0.1
    assert type(converted(name, "3")) is float


@pytest.mark.parametrize("written", ["2s", "2000ms", "2000"])
def test_what_says_its_unit_is_in_that(written: str) -> None:
    assert converted("timeout_ms", written) == 2000.0


@pytest.mark.parametrize("written", ["90s", "1.5min", "1.5"])
def test_what_is_annotated_with_its_unit_is_in_that(written: str) -> None:
    assert converted("interval", written) == 1.5


@pytest.mark.parametrize("written", ["20dBm", "0.1W", "100mW", "-10dBW"])
@pytest.mark.parametrize(
    ("name", "value"), [("power_w", 0.1), ("power_mw", 100.0), ("power_dbm", 20.0), ("power_dbw", -10.0)]
)
def test_powers_are_in_the_unit_of_the_name(name: str, value: float, written: str) -> None:
    assert converted(name, written) == pytest.approx(value, rel=1e-12)


@given(st.floats(-200, 200), st.sampled_from([("dbm", "dBm"), ("dbw", "dBW"), ("mw", "mW"), ("w", "W")]))
def test_a_number_is_in_the_unit_of_the_name(number: float, end: tuple[str, str]) -> None:
    assert converted(f"power_{end[0]}", f"{number!r}") == number
    assert converted(f"power_{end[0]}", f"{number!r}{end[1]}") == number


@pytest.mark.parametrize("name", ["real", "real_by_annotation"])
@pytest.mark.parametrize("written", ["90deg", "1rad", "-2 * 1deg"])
def test_an_angle_is_refused_where_nothing_says_its_unit(name: str, written: str) -> None:
    with pytest.raises(BadValue) as caught:
        converted(name, written)
    assert caught.value.expected == f"a plain number, or an attribute named `{name}_deg` or `{name}_rad`"


@pytest.mark.parametrize(("name", "value"), [("heading_deg", 90.0), ("heading_rad", math.pi / 2)])
def test_an_angle_is_in_the_unit_of_the_name(name: str, value: float) -> None:
    assert converted(name, "90deg") == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(("name", "written"), [("whole", "5s"), ("whole", "1.5"), ("period_ms", "5500us")])
def test_where_a_parameter_is_an_int_what_to_write_for_other_numbers_is_said(name: str, written: str) -> None:
    with pytest.raises(BadValue) as caught:
        converted(name, written)
    default = getattr(Mobile, name)
    assert caught.value.suggestion == f"; for other numbers write `{name}: float = {default}` in the class"


@pytest.mark.parametrize("written", ["5000", "5s", "5000ms", "2500 * 2ms"])
def test_an_int_is_in_the_unit_of_the_name(written: str) -> None:
    assert converted("period_ms", written) == 5000
    assert type(converted("period_ms", written)) is int


def test_decibels_stay_decibels() -> None:
    assert (converted("lost_db", "3"), converted("lost_db", "3dB")) == (3.0, 3.0)


def test_other_types_are_kept() -> None:
    assert (
        converted("whole", "3"),
        converted("text", '"y"'),
        converted("flag", "true"),
    ) == (3, "y", True)
    assert converted("replaced", '"y"') == "y"


@pytest.mark.parametrize(
    ("name", "written"),
    [
        ("whole", "3.0"),
        ("whole", "3s"),
        ("whole", "true"),
        ("flag", "1"),
        ("text", "1"),
        ("real", "true"),
        ("real", "nan"),
        ("timeout_ms", "5m"),
        ("interval", "5m"),
        ("power_w", "3V"),
        ("power_mw", "3s"),
        ("power_mw", "3dB"),
        ("power_dbm", "3dB"),
        ("power_dbm", "0W"),
        ("lost_db", "3dBm"),
        ("lost_db", "3kg"),
        ("lost_db", "3x"),
    ],
)
def test_other_types_are_refused(name: str, written: str) -> None:
    with pytest.raises(BadValue):
        converted(name, written)


def test_that_a_parameter_is_an_int_is_said() -> None:
    kinds = parameters_of(Mobile)
    assert kinds["whole"].expected == "a whole number, as the parameter is an int"
    assert kinds["period_ms"].expected == "a whole number of ms, as the parameter is an int"
