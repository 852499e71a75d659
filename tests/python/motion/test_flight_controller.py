"""Flights of a quadcopter with its built-in controller."""

import itertools
import math
from collections.abc import Callable

import pytest

from gradysim.motion.flight_controller import STEP_S, FlightController
from gradysim.motion.position_error import position_error
from gradysim.motion.wind import Wind, WindAtVehicle
from gradysim.protocol.position import Position

START = (0.0, 0.0, 20.0)


@pytest.fixture
def vehicle() -> Callable[..., FlightController]:
    """`vehicle(speed=10, wind=Wind())`: a vehicle that hovers at START."""

    def make(speed: float = 10.0, wind: Wind | None = None) -> FlightController:
        return FlightController(START, speed, WindAtVehicle(wind or Wind(), 1, 0))

    return make


def flown(vehicle: FlightController, seconds: float) -> list[Position]:
    positions = []
    for _ in range(round(seconds / STEP_S)):
        vehicle.step()
        positions.append(vehicle.position)
    return positions


def speeds(positions: list[Position]) -> list[float]:
    return [math.dist(one, other) / STEP_S for one, other in itertools.pairwise(positions)]


def test_it_hovers_without_a_target(vehicle: Callable[..., FlightController]) -> None:
    assert max(math.dist(position, START) for position in flown(vehicle(), 5)) < 1e-9


def test_it_speeds_up_flies_and_stops_at_its_target(vehicle: Callable[..., FlightController]) -> None:
    flying = vehicle()
    flying.go_to((100.0, 0.0, 20.0))
    positions = flown(flying, 20)
    assert 0.5 < positions[99][0] < 1.25  # at most half of 2.5 m/s^2 times the square of 1 s
    assert max(speeds(positions)) == pytest.approx(10, rel=0.01)
    assert max(x for x, _, _ in positions) < 100.1
    assert math.dist(positions[-1], (100, 0, 20)) < 0.05


def test_it_climbs_and_descends_slowly(vehicle: Callable[..., FlightController]) -> None:
    flying = vehicle()
    flying.go_to((0.0, 0.0, 40.0))
    assert max(speeds(flown(flying, 15))) == pytest.approx(2.5, rel=0.02)
    flying.go_to((0.0, 0.0, 0.0))
    down = flown(flying, 35)
    assert max(speeds(down)) == pytest.approx(1.5, rel=0.02)
    assert down[-1][2] == 0


def test_without_speed_it_stops(vehicle: Callable[..., FlightController]) -> None:
    flying = vehicle()
    flying.go_to((1000.0, 0.0, 20.0))
    brakes_at_m = flown(flying, 12)[-1][0]
    flying.speed_mps = 0.0
    assert flown(flying, 8)[-1][0] - brakes_at_m == pytest.approx(23, abs=3)


def test_it_flies_over_the_ground_and_not_on_it() -> None:
    flying = FlightController((0.0, 0.0, 0.0), 10.0, WindAtVehicle(Wind(), 1, 0))
    flying.go_to((30.0, 0.0, 0.0))
    positions = flown(flying, 15)
    assert max(z for _, _, z in positions) == pytest.approx(0.5, abs=0.1)
    assert positions[-1] == pytest.approx((30, 0, 0), abs=0.1)


def test_it_holds_its_place_in_wind(vehicle: Callable[..., FlightController]) -> None:
    hovering = vehicle(wind=Wind(8.0, 1.0, 1.5))
    flown(hovering, 10)
    assert max(math.dist(position, START) for position in flown(hovering, 20)) < 0.2


def test_it_flies_by_the_position_that_it_knows() -> None:
    still = WindAtVehicle(Wind(), 1, 0)
    hovering = FlightController(START, 10.0, still, position_error(1, 0, 2.0, 30.0))
    end = flown(hovering, 30)[-1]
    error = position_error(1, 0, 2.0, 30.0).at(30.0)
    known = tuple(here + off for here, off in zip(end, error, strict=True))
    assert math.dist(known, START) < 0.9 < math.dist(end, START)
