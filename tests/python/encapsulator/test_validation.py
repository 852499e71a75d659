"""Validation of commands and timers. The conformance tests run it in both modes."""

import math
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from gradysim.encapsulator.validation import (
    checked_destination,
    checked_interface,
    finite_number,
    geo_target,
    is_speed,
    three_numbers,
    wrong_communication,
    wrong_mobility,
    wrong_timer,
)
from gradysim.protocol.defaults import MOST_INTERFACES
from gradysim.protocol.errors import CommunicationException, MasslessMobilityException
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    GotoGeoCoordsMobilityCommand,
    MobilityCommand,
    SetSpeedMobilityCommand,
    SetVelocityMobilityCommand,
)
from gradysim.protocol.position import Position, geo_to_cartesian

SET_SPEED: Any = 3


@pytest.mark.parametrize(
    "command",
    [
        BroadcastMessageCommand("a"),
        SendMessageCommand("a", 2, interface=15),
        SimpleNamespace(command_type=1, message="a"),
    ],
)
def test_valid_messages(command: Any) -> None:
    assert wrong_communication(command, 0, range(3)) == ""


@pytest.mark.parametrize("destination", [3, 1, 1.5, -1, None])
def test_invalid_destinations(destination: Any) -> None:
    assert wrong_communication(SendMessageCommand("a", destination), 1, range(3))


@pytest.mark.parametrize("value", [1, True, 1.0, np.int64(1), np.float32(1), Decimal(1), Fraction(1)])
def test_a_number_that_equals_an_id_is_a_destination(value: Any) -> None:
    assert {1: "found"}.get(value) == "found"
    assert type(checked_destination(value)) is int
    assert checked_destination(value) == 1


@pytest.mark.parametrize(
    "value",
    [-1, 2**31, 2**70, 1.5, float("nan"), float("inf"), "1", b"1", None, [1], np.array([1]), np.array(1)],
    ids=repr,
)
def test_other_values_are_not_destinations(value: Any) -> None:
    with pytest.raises(CommunicationException) as error:
        checked_destination(value)
    assert repr(value) in str(error.value)


@pytest.mark.parametrize("index", [0, 1, MOST_INTERFACES - 1])
def test_valid_interfaces(index: int) -> None:
    assert checked_interface(index) == index


@pytest.mark.parametrize("value", [-1, MOST_INTERFACES, 2**70, True, False, 1.0, "two", None, [1]])
def test_invalid_interfaces(value: Any) -> None:
    with pytest.raises(CommunicationException) as error:
        checked_interface(value)
    assert repr(value) in str(error.value)


@pytest.mark.parametrize("time_s", [1, 1.5, 1e300])
def test_valid_timers(time_s: float) -> None:
    assert wrong_timer("a", time_s, 0, now_s=1.0) == ""


@pytest.mark.parametrize("time_s", [0.9, math.nan, math.inf, "2", None])
def test_invalid_times(time_s: Any) -> None:
    assert repr(time_s) in wrong_timer("a", time_s, 1, now_s=1.0)


@pytest.mark.parametrize("value", [1, 1.0, Fraction(1), Decimal(1)])
def test_finite_numbers_become_floats(value: Any) -> None:
    assert (finite_number(value), type(finite_number(value))) == (1.0, float)


@pytest.mark.parametrize(
    "value", [math.nan, -math.inf, pytest.param(10**400, id="huge"), None, "1", [1], 1j, object()]
)
def test_other_values_are_not_finite_numbers(value: Any) -> None:
    assert finite_number(value) is None


def test_three_numbers_of_a_command() -> None:
    assert three_numbers(GotoCoordsMobilityCommand(1, 2.5, -3)) == (1.0, 2.5, -3.0)
    assert three_numbers(SetSpeedMobilityCommand(5)) is None


@pytest.mark.parametrize("place", range(3))
def test_all_three_numbers_must_be_finite(place: int) -> None:
    numbers = [1.0, 2.0, 3.0]
    numbers[place] = math.nan
    assert three_numbers(GotoCoordsMobilityCommand(*numbers)) is None


@pytest.mark.parametrize(
    "command",
    [
        GotoCoordsMobilityCommand(1, 2, 1e7),
        SetSpeedMobilityCommand(0),
        MobilityCommand(SET_SPEED, 5, 0, 0),
        MobilityCommand(SET_SPEED, 5, 0, 0, 0, 0, 0),
    ],
)
def test_valid_mobility_commands(command: Any) -> None:
    assert wrong_mobility(command, 0, can_move=True) == ""


@pytest.mark.parametrize(
    "command",
    [
        SetVelocityMobilityCommand(1, 2, 3),
        SetVelocityMobilityCommand(1, None, 3),  # type: ignore[arg-type]
        SetVelocityMobilityCommand(5, 0, 0),
        MobilityCommand(SET_SPEED, 1, 0, 3),
        MobilityCommand(SET_SPEED, 1, math.nan, 0),
        MobilityCommand(SET_SPEED, 1, "0"),  # type: ignore[arg-type]
    ],
)
def test_a_velocity_is_not_a_speed(command: MobilityCommand) -> None:
    assert not is_speed(command)
    assert "velocity" in wrong_mobility(command, 1, can_move=True)


def test_a_velocity_of_another_package_is_not_a_speed() -> None:
    @dataclass
    class Command:
        command_type: int
        param_1: float
        param_2: float = 0
        param_3: float = 0

    velocity = type("SetVelocityMobilityCommand", (Command,), {})
    assert is_speed(Command(3, 5))
    assert not is_speed(velocity(3, 5))


def test_a_stationary_node_refuses_valid_commands() -> None:
    command = SetSpeedMobilityCommand(3)
    assert repr(command) in wrong_mobility(command, 1, can_move=False)
    assert "follow" not in wrong_mobility(SetSpeedMobilityCommand(math.nan), 1, can_move=False)


ORIGIN: Position = (10.0, 20.0, 5.0)
RIO: Position = (-22.9, -43.2, 0.0)


def refusal(place: Any, origin: Position) -> str:
    with pytest.raises(MasslessMobilityException) as raised:
        geo_target(GotoGeoCoordsMobilityCommand(*place), 3, origin)
    return str(raised.value)


@pytest.mark.parametrize("wrong", [math.nan, math.inf, pytest.param(10**400, id="huge"), None, "5"])
@pytest.mark.parametrize("place", range(3))
def test_geographic_coordinates_must_be_finite(wrong: Any, place: int) -> None:
    target: list[Any] = [1.0, 2.0, 3.0]
    target[place] = wrong
    assert repr(wrong) in refusal(target, ORIGIN)


@pytest.mark.parametrize("latitude", [-90.1, 91])
def test_a_latitude_is_at_most_90_degrees(latitude: float) -> None:
    assert repr(latitude) in refusal((latitude, 0, 0), ORIGIN)


@pytest.mark.parametrize("place", [(0, 160, 0), (10, 20, 1e8)])
def test_a_target_outside_of_the_scene(place: Position) -> None:
    assert " 10000000 m" in refusal(place, ORIGIN)


@pytest.mark.parametrize(
    ("place", "origin", "hint"),
    [
        ((-43.2001, -22.9001, 10), RIO, "latitude -22.9001, longitude -43.2001?"),
        ((32.86, 39.92, 10), (39.93, 32.85, 0), "latitude 39.92, longitude 32.86?"),  # near the diagonal
    ],
)
def test_exchanged_latitude_and_longitude(place: Position, origin: Position, hint: str) -> None:
    assert hint in refusal(place, origin)


@pytest.mark.parametrize(
    ("place", "origin"),
    [
        ((10.001, 20.002, 7), ORIGIN),
        ((-43.2, -22.9, 10), ORIGIN),  # far away both ways
        ((-22.9, -43.2, 10), RIO),
        ((-23.9, -43.2, 10), RIO),  # 111 km
        ((10.1, 9.9, 0), (10.0, 10.0, 0.0)),  # near in both orders
        ((46.42, 45.05, 0), (45.03, 46.24, 0.0)),  # 181 km, across the diagonal
        ((36.54, 39.07, 0), (38.69, 36.08, 0.0)),  # 353 km, and 52 km the other way
        ((5.0, 100.0, 0), ORIGIN),  # exchanged, it is not a latitude
    ],
)
def test_other_targets_are_relative_to_the_origin(place: Position, origin: Position) -> None:
    assert geo_target(GotoGeoCoordsMobilityCommand(*place), 3, origin) == geo_to_cartesian(origin, place)
