"""Who has a vehicle do what is wanted of it last; the vehicle is played."""

import pytest

from gradysim.sitl.pilot import Pilot
from gradysim.sitl.vehicle_clock import VehicleClockLoop


class Vehicle:
    """Writes down its orders."""

    def __init__(self, loop):
        self.loop = loop
        self.orders = []
        self.answers = True

    def go_to(self, latitude, longitude, height_m):
        self.orders.append(("go_to", latitude, longitude, height_m))

    def set_velocity(self, *velocity_mps):
        self.orders.append(("velocity", *velocity_mps))

    async def set_speed(self, speed_mps):
        self.orders.append(("speed", speed_mps))
        if not self.answers:
            await self.loop.create_future()


@pytest.fixture
def loop():
    loop = VehicleClockLoop()
    yield loop
    loop.cancel_all()


@pytest.fixture
def vehicle(loop):
    return Vehicle(loop)


@pytest.fixture
def pilot(loop, vehicle):
    """One in flight, who has had its first speed confirmed."""
    pilot = Pilot(vehicle, lambda point: (point[0] / 100, point[1] / 100, point[2]), 10.0)
    loop.create_task(pilot.attend())
    loop.turn(0.0)
    assert vehicle.orders == [("speed", 10.0)]
    vehicle.orders.clear()
    return pilot


def test_a_target_is_a_place_on_earth(pilot, vehicle):
    pilot.go_to((100.0, 200.0, 5.0))
    assert vehicle.orders == [("go_to", 1.0, 2.0, 5.0)]


def test_a_target_below_the_ground_is_the_ground_at_the_same_place(pilot, vehicle):
    pilot.go_to((100.0, 200.0, -20.0))
    assert vehicle.orders == [("go_to", 1.0, 2.0, 0.0)]


def test_a_speed_is_told_in_the_next_turn(pilot, vehicle, loop):
    pilot.set_speed(4.0)
    assert (pilot.has_news, vehicle.orders) == (True, [])
    loop.turn(0.0)
    assert (pilot.has_news, vehicle.orders) == (False, [("speed", 4.0)])


def test_a_speed_that_arducopter_ignores_is_refused_and_the_one_before_holds(pilot, vehicle, loop):
    for speed_mps in (0.1, 0.199):
        with pytest.raises(ValueError, match=r"^an autopilot flies at 0\.2 m/s or faster, or stands at 0$"):
            pilot.set_speed(speed_mps)
    assert (pilot.has_news, vehicle.orders) == (False, [])
    pilot.set_velocity((1.0, 0.0, 0.0))
    pilot.go_to((100.0, 0.0, 5.0))
    loop.turn(0.0)
    assert vehicle.orders[-1] == ("speed", 10.0)


def test_the_lowest_speed_is_obeyed_however_it_was_rounded(pilot, vehicle, loop):
    pilot.set_speed(0.72 / 3.6)
    loop.turn(0.0)
    assert vehicle.orders == [("speed", pytest.approx(0.2))]


def test_a_velocity_is_renewed_once_a_second_whatever_speeds_are_ordered(pilot, vehicle, loop):
    pilot.set_velocity((1.0, 2.0, 3.0))
    for tick in range(1, 51):
        if tick % 5 == 0:
            pilot.set_speed(4.0 + tick)
        loop.turn(tick / 10)
    assert vehicle.orders.count(("velocity", 1.0, 2.0, 3.0)) == 6
    assert len([order for order in vehicle.orders if order[0] == "speed"]) == 10


def test_it_is_renewed_while_a_speed_waits_for_its_answer(pilot, vehicle, loop):
    vehicle.answers = False
    pilot.set_speed(4.0)
    pilot.set_velocity((1.0, 2.0, 3.0))
    for tick in range(1, 51):
        loop.turn(tick / 10)
    assert vehicle.orders.count(("velocity", 1.0, 2.0, 3.0)) == 6


def test_a_target_ends_a_velocity_and_the_speed_holds_again(pilot, vehicle, loop):
    pilot.set_velocity((1.0, 0.0, 0.0))
    pilot.go_to((100.0, 0.0, 5.0))
    vehicle.orders.clear()
    for tick in range(1, 31):
        loop.turn(tick / 10)
    assert vehicle.orders == [("speed", 10.0)]


def test_at_speed_0_it_stands_and_a_velocity_ends_with_the_next_target(pilot, vehicle):
    pilot.set_speed(0.0)
    pilot.set_velocity((1.0, 0.0, 0.0))
    pilot.go_to((100.0, 0.0, 5.0))
    stands, flies, stands_again = vehicle.orders
    assert stands == stands_again == ("velocity", 0.0, 0.0, 0.0)
    assert flies == ("velocity", 1.0, 0.0, 0.0)


def test_the_next_speed_takes_it_to_the_target_of_meanwhile(pilot, vehicle, loop):
    pilot.set_speed(0.0)
    pilot.go_to((100.0, 0.0, 5.0))
    vehicle.orders.clear()
    pilot.set_speed(3.0)
    loop.turn(0.0)
    assert vehicle.orders == [("go_to", 1.0, 0.0, 5.0), ("speed", 3.0)]
