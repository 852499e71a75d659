"""The pilot makes a vehicle follow the latest command; the test plays the vehicle."""

from types import SimpleNamespace

import pytest

from gradysim.sitl.frame import cartesian_to_geo
from gradysim.sitl.lock_step import VehicleClockLoop
from gradysim.sitl.pilot import Pilot


class Vehicle:
    """Logs its commands."""

    def __init__(self, loop):
        self.loop = loop
        self.orders = []
        self.answers = True
        self.link = self
        self.waiting = []
        self.position = None
        self.is_in_air, self.is_on_ground = True, False

    async def wait_for(self, accept, timeout_s):
        assert timeout_s is None
        self.waiting.append((accept, news := self.loop.create_future()))
        return await news

    def tell(self, point, *, landed=False, kind="GLOBAL_POSITION_INT"):
        """Report its position, (x, y, z) in meters; then give the pilot its turn."""
        self.position = place_of(point)
        self.is_in_air, self.is_on_ground = not landed, landed
        message = SimpleNamespace(get_type=lambda: kind)
        told, self.waiting = self.waiting, []
        for accept, news in told:
            if accept(message):
                news.set_result(message)
            else:
                self.waiting.append((accept, news))
        self.loop.turn(self.loop.time())

    def go_to(self, latitude, longitude, height_m):
        self.orders.append(("go_to", latitude, longitude, height_m))

    def set_velocity(self, *velocity_mps):
        self.orders.append(("velocity", *velocity_mps))

    async def set_speed(self, speed_mps):
        self.orders.append(("speed", speed_mps))
        if not self.answers:
            await self.loop.create_future()


def place_of(point):
    return cartesian_to_geo((-15.0, -47.0, 0.0), point)


UP, DOWN = ("velocity", 0.0, 0.0, 1.0), ("velocity", 0.0, 0.0, -0.5)


def to(*point):
    return ("go_to", *place_of(point))


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
    """Return a pilot in flight, whose first speed is confirmed."""
    return attending(loop, vehicle, (0.0, 0.0, 10.0))


def attending(loop, vehicle, start):
    pilot = Pilot(vehicle, place_of, start, 10.0)
    loop.create_task(pilot.attend())
    loop.turn(0.0)
    assert vehicle.orders == [("speed", 10.0)]
    vehicle.orders.clear()
    return pilot


def test_a_target_is_a_place_on_earth(pilot, vehicle):
    pilot.go_to((100.0, 200.0, 5.0))
    assert vehicle.orders == [to(100.0, 200.0, 5.0)]


def test_a_speed_is_told_in_the_next_turn(pilot, vehicle, loop):
    pilot.set_speed(4.0)
    assert (pilot.has_new_speed, vehicle.orders) == (True, [])
    loop.turn(0.0)
    assert (pilot.has_new_speed, vehicle.orders) == (False, [("speed", 4.0)])


def test_a_speed_that_arducopter_ignores_is_refused_and_the_one_before_holds(pilot, vehicle, loop):
    for speed_mps in (0.1, 0.199):
        with pytest.raises(ValueError, match=r"0\.2 m/s"):
            pilot.set_speed(speed_mps)
    assert (pilot.has_new_speed, vehicle.orders) == (False, [])
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
    assert vehicle.orders == [to(100.0, 0.0, 5.0), ("speed", 3.0)]


def test_speed_0_and_another_one_let_it_hold_its_start(pilot, vehicle, loop):
    pilot.set_speed(0.0)
    pilot.set_speed(3.0)
    assert vehicle.orders == [("velocity", 0.0, 0.0, 0.0), to(0.0, 0.0, 10.0)]


@pytest.mark.parametrize("height_m", [0.1, 0.0, -20.0])
def test_over_a_target_on_the_ground_it_goes_straight_down(pilot, vehicle, height_m):
    pilot.go_to((100.0, 200.0, height_m))
    vehicle.tell((99.0, 200.0, 0.5))
    vehicle.tell((100.0, 200.0, 2.0))
    assert vehicle.orders == [to(100.0, 200.0, 0.5)]
    vehicle.tell((100.2, 200.2, 0.7))
    assert vehicle.orders[1:] == [DOWN]


def test_what_starts_on_the_ground_stands_there_and_goes_on_pushing_down(loop, vehicle):
    attending(loop, vehicle, (0.0, 0.0, 0.0))
    vehicle.tell((0.0, 0.1, 0.0))
    for second in range(1, 10):
        vehicle.tell((0.0, 0.1, 0.0), landed=second > 3)
        loop.turn(float(second))
    assert set(vehicle.orders) == {DOWN}
    assert len(vehicle.orders) == 10


def test_a_hover_just_above_the_ground_is_left_alone(loop, vehicle):
    attending(loop, vehicle, (0.0, 0.0, 0.2))
    vehicle.tell((0.0, 0.0, 0.2))
    assert vehicle.orders == []


@pytest.mark.parametrize(("target", "height_m"), [((50.0, 0.0, 20.0), 20.0), ((50.0, 0.0, -1.0), 0.5)])
def test_from_the_ground_it_rises_first_and_then_has_its_speed_again(pilot, vehicle, loop, target, height_m):
    vehicle.tell((0.0, 0.0, 0.0), landed=True)
    vehicle.orders.clear()
    pilot.go_to(target)
    vehicle.tell((0.0, 0.0, 0.6), landed=True)
    vehicle.tell((0.0, 0.0, 0.4))
    assert vehicle.orders == [UP]
    vehicle.tell((0.0, 0.0, 0.5), kind="EXTENDED_SYS_STATE")
    loop.turn(0.0)
    assert vehicle.orders == [UP, to(50.0, 0.0, height_m), ("speed", 10.0)]


def test_who_turns_out_to_have_landed_rises_again(pilot, vehicle):
    pilot.go_to((50.0, 0.0, 20.0))
    vehicle.tell((0.0, 0.0, 0.0), landed=True)
    assert vehicle.orders == [to(50.0, 0.0, 20.0), UP]


def test_who_has_landed_near_its_target_has_arrived(pilot, vehicle):
    pilot.go_to((50.0, 0.0, 0.0))
    vehicle.tell((50.0, 0.9, 0.0), landed=True)
    assert vehicle.orders[1:] == [DOWN]
    pilot.go_to((50.0, 0.5, 0.0))
    assert vehicle.orders[2:] == [DOWN]


def test_at_speed_0_who_stands_on_the_ground_goes_on_standing(pilot, vehicle):
    pilot.go_to((0.0, 0.0, 0.0))
    vehicle.tell((0.0, 0.0, 0.0), landed=True)
    vehicle.orders.clear()
    pilot.set_speed(0.0)
    pilot.go_to((50.0, 0.0, 20.0))
    assert vehicle.orders == []
    pilot.set_speed(2.0)
    assert vehicle.orders == [UP]


def test_a_velocity_is_held_whatever_the_ground(pilot, vehicle):
    vehicle.tell((0.0, 0.0, 0.0), landed=True)
    vehicle.orders.clear()
    pilot.set_velocity((3.0, 0.0, 0.0))
    vehicle.tell((0.0, 0.0, 0.0), landed=True)
    vehicle.tell((0.0, 0.0, 5.0))
    assert vehicle.orders == [("velocity", 3.0, 0.0, 0.0)]


def test_what_does_not_tell_of_its_place_changes_nothing(loop, vehicle):
    attending(loop, vehicle, (0.0, 0.0, 0.0))
    vehicle.tell((0.0, 0.0, 5.0), kind="HEARTBEAT")
    assert vehicle.orders == []
