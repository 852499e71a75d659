"""Parameters of protocols: their names, units and values."""

import math
from dataclasses import InitVar, dataclass, field
from typing import Annotated, ClassVar, Final

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.errors import BadValue
from gradysim.scenario.parse.expressions import parse_value
from gradysim.scenario.schema.native_protocols import NativeParameter, NativeProtocol
from gradysim.scenario.schema.parameters import parameters_of, parametrize, unit_of
from python.quiet_protocol import Quiet


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
    register = 1  # a method of all abstract classes, but not of protocols
    replaced = "now a string"  # type: ignore[assignment]
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
        "waypoints",
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
    assert caught.value.hint == f"; for other numbers write `{name}: float = {default}` in the class"


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


class Native(NativeProtocol):
    _parameters: ClassVar = {
        "interval": NativeParameter("s", "Time between two messages"),
        "count": NativeParameter("", "Number of messages"),
        "limit_s": NativeParameter("transmissions", "Then it ends"),
    }


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("interval_s", "s"),
        ("time_out_ms", "ms"),
        ("altitude_m", "m"),
        ("carrier_mhz", "MHz"),
        ("bitrate_mbps", "Mbps"),
        ("heading_deg", "deg"),
        ("power_w", "W"),
        ("power_mw", "mW"),
        ("power_dbm", "dBm"),
        ("power_dbw", "dBW"),
        ("lost_db", "dB"),
    ],
)
def test_the_end_of_a_name_says_it(name: str, unit: str) -> None:
    assert unit_of(Quiet, name) == unit


@pytest.mark.parametrize(
    "name", ["interval", "s", "vector_x", "point_a", "size_b", "rician_k", "retry_min", "interval_S"]
)
def test_other_names_say_nothing(name: str) -> None:
    assert unit_of(Quiet, name) is None


class Annotating(Quiet):
    interval: Annotated[float, "s"] = 5.0
    as_text: "Annotated[float, 'ms']" = 5.0
    constant: ClassVar[Annotated[float, "m"]] = 1.0
    size: Annotated[int, "B", "on the air"] = 10
    delay_ms: Annotated[float, "us"] = 1.0
    speed: Annotated[float, "fast"] = 1.0
    plain: float = 1.0


class Heir(Annotating):
    interval = 2.0
    size: int = 3


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("interval", "s"),
        ("as_text", "ms"),
        ("constant", "m"),
        ("size", "B"),
        ("delay_ms", "us"),
        ("speed", None),
        ("plain", None),
    ],
)
def test_an_annotation_says_it(name: str, unit: str | None) -> None:
    assert unit_of(Annotating, name) == unit


@pytest.mark.parametrize(("name", "unit"), [("interval", "s"), ("size", None)])
def test_the_last_annotation_counts(name: str, unit: str | None) -> None:
    assert unit_of(Heir, name) == unit


@pytest.mark.parametrize(
    ("name", "unit"), [("interval", "s"), ("count", None), ("limit_s", None), ("other_s", None)]
)
def test_native_protocols_declare_theirs(name: str, unit: str | None) -> None:
    assert unit_of(Native, name) == unit


class Flying(Quiet):
    """Computes a value from a parameter in its constructor."""

    interval: float = 1.0

    def __init__(self) -> None:
        self.at_construction = self.interval


def test_parameters_hold_in_the_constructor() -> None:
    protocol = parametrize(Flying, {"interval": 2.5})()
    assert isinstance(protocol, Flying)
    assert protocol.at_construction == 2.5


def test_the_class_itself_is_left_alone() -> None:
    parametrize(Flying, {"interval": 2.5})
    assert Flying.interval == 1.0


def test_goes_by_the_name_of_the_class() -> None:
    cls = parametrize(Flying, {"interval": 2.5})
    assert (cls.__name__, cls.__qualname__, cls.__module__) == (
        "Flying",
        "Flying",
        Flying.__module__,
    )
    assert cls.__doc__ == Flying.__doc__


def test_equal_parameters_give_the_same_class() -> None:
    assert parametrize(Flying, {"interval": 2.5, "x": 1}) is parametrize(Flying, {"x": 1, "interval": 2.5})


def test_values_of_other_types_give_another_class() -> None:
    assert len({parametrize(Flying, {"interval": value}) for value in (1, 1.0, True)}) == 3


def test_no_parameters_give_the_class() -> None:
    assert parametrize(Flying, {}) is Flying


@dataclass
class FlyingData(Flying):
    first: int = 1
    second: int = 2
    third: list[int] = field(default_factory=list)


def test_parameters_hold_in_the_constructor_of_a_data_class() -> None:
    protocol = parametrize(FlyingData, {"second": 5, "interval": 2.5})()
    assert isinstance(protocol, FlyingData)
    assert (protocol.first, protocol.second, protocol.third, protocol.interval) == (1, 5, [], 2.5)
    assert FlyingData().second == 2


class DerivedData(FlyingData):
    def __init__(self) -> None:
        super().__init__()
        self.twice = 2 * self.first


@dataclass
class WithItsOwnConstructor(Quiet):
    first: int = 1

    def __init__(self) -> None:
        self.twice = 2 * self.first


@pytest.mark.parametrize("cls", [DerivedData, WithItsOwnConstructor])
def test_a_constructor_that_is_written_out_runs(cls: type[Quiet]) -> None:
    protocol = parametrize(cls, {"first": 5})()
    assert (protocol.first, protocol.twice) == (5, 10)  # type: ignore[attr-defined]


class Choosy(FlyingData):
    def __init__(self) -> None:
        super().__init__(3, third=[4])


def test_what_a_derived_class_gives_to_the_constructor_counts() -> None:
    protocol = parametrize(Choosy, {"first": 5, "second": 6})()
    assert isinstance(protocol, Choosy)
    assert (protocol.first, protocol.second, protocol.third) == (3, 6, [4])


@dataclass(kw_only=True)
class AskingOnly(Quiet):
    start: InitVar[float] = 1.0

    def __post_init__(self, start: float) -> None:
        self.begun = start


def test_what_only_the_constructor_takes_is_a_parameter() -> None:
    assert parametrize(AskingOnly, {"start": 5.0})().begun == 5.0  # type: ignore[attr-defined]
    assert AskingOnly().begun == 1.0


@dataclass
class WithMethods(Quiet):
    first: int = 1

    def __repr__(self) -> str:
        return "own"

    def __eq__(self, other: object) -> bool:
        return self is other

    def __hash__(self) -> int:
        return 7


def test_what_a_data_class_has_of_its_own_stays() -> None:
    one, other = (parametrize(WithMethods, {"first": 5})() for _ in range(2))
    assert (repr(one), hash(one), one == other) == ("own", 7, False)
