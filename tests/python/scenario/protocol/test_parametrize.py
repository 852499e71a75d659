from dataclasses import InitVar, dataclass, field

import pytest

from gradysim.scenario.protocol.parametrize import parametrize
from python.quiet_protocol import Quiet


class Mobile(Quiet):
    """What flies."""

    interval: float = 1.0

    def __init__(self) -> None:
        self.at_construction = self.interval


def test_parameters_hold_in_the_constructor() -> None:
    protocol = parametrize(Mobile, {"interval": 2.5})()
    assert isinstance(protocol, Mobile)
    assert protocol.at_construction == 2.5


def test_the_class_itself_is_left_alone() -> None:
    parametrize(Mobile, {"interval": 2.5})
    assert Mobile.interval == 1.0


def test_goes_by_the_name_of_the_class() -> None:
    cls = parametrize(Mobile, {"interval": 2.5})
    assert (cls.__name__, cls.__qualname__, cls.__module__) == (
        "Mobile",
        "Mobile",
        Mobile.__module__,
    )
    assert cls.__doc__ == Mobile.__doc__


def test_equal_parameters_give_the_same_class() -> None:
    assert parametrize(Mobile, {"interval": 2.5, "x": 1}) is parametrize(Mobile, {"x": 1, "interval": 2.5})


def test_values_of_other_types_give_another_class() -> None:
    assert len({parametrize(Mobile, {"interval": value}) for value in (1, 1.0, True)}) == 3


def test_no_parameters_give_the_class() -> None:
    assert parametrize(Mobile, {}) is Mobile


@dataclass
class FlyingDataClass(Mobile):
    first: int = 1
    second: int = 2
    third: list[int] = field(default_factory=list)


def test_parameters_hold_in_the_constructor_of_a_data_class() -> None:
    protocol = parametrize(FlyingDataClass, {"second": 5, "interval": 2.5})()
    assert isinstance(protocol, FlyingDataClass)
    assert (protocol.first, protocol.second, protocol.third, protocol.interval) == (1, 5, [], 2.5)
    assert FlyingDataClass().second == 2


class Derived(FlyingDataClass):
    def __init__(self) -> None:
        super().__init__()
        self.twice = 2 * self.first


@dataclass
class WithItsOwnConstructor(Quiet):
    first: int = 1

    def __init__(self) -> None:
        self.twice = 2 * self.first


@pytest.mark.parametrize("cls", [Derived, WithItsOwnConstructor])
def test_a_constructor_that_is_written_out_runs(cls: type[Quiet]) -> None:
    protocol = parametrize(cls, {"first": 5})()
    assert (protocol.first, protocol.twice) == (5, 10)  # type: ignore[attr-defined]


class Choosy(FlyingDataClass):
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
class Told(Quiet):
    first: int = 1

    def __repr__(self) -> str:
        return "told"

    def __eq__(self, other: object) -> bool:
        return self is other

    def __hash__(self) -> int:
        return 7


def test_what_a_data_class_has_of_its_own_stays() -> None:
    one, other = (parametrize(Told, {"first": 5})() for _ in range(2))
    assert (repr(one), hash(one), one == other) == ("told", 7, False)
