"""Physics of the vehicle: the effect of its motors."""

import math

import pytest
from hypothesis import given, strategies

from gradysim.motion import quadcopter
from gradysim.motion.quadcopter import GRAVITY_MPS2, Quadcopter

STEP_S = 1 / 400
HIGH_M = -100.0


def throttle_for(share):
    """Return the throttle for this ratio of the largest thrust."""
    e = quadcopter.THRUST_EXPO
    return (math.sqrt((1 - e) ** 2 + 4 * e * share) - (1 - e)) / (2 * e)


HOVER = throttle_for(quadcopter.HOVER_THRUST)


def flown(throttles, seconds, wind=(0.0, 0.0, 0.0), height=HIGH_M):
    body = Quadcopter(wind)
    body.position_m = (0.0, 0.0, height)
    for _ in range(round(seconds / STEP_S)):
        body.step(throttles, STEP_S)
    return body


def test_at_its_hover_thrust_it_stays_where_it_is():
    body = flown([HOVER] * 4, 10)
    assert body.position_m == pytest.approx((0, 0, HIGH_M), abs=1e-6)
    assert body.specific_force_mps2 == pytest.approx((0, 0, -GRAVITY_MPS2))


def test_without_thrust_it_falls_and_feels_nothing_at_first():
    body = flown([0.0] * 4, STEP_S)
    assert body.velocity_mps == pytest.approx((0, 0, GRAVITY_MPS2 * STEP_S))
    assert body.specific_force_mps2 == pytest.approx((0, 0, 0), abs=1e-9)


def test_a_long_fall_has_the_speed_at_which_drag_is_weight():
    terminal = quadcopter.MASS_KG * GRAVITY_MPS2 / quadcopter.DRAG_KGPS
    assert flown([0.0] * 4, 60, height=-10_000.0).velocity_mps[2] == pytest.approx(terminal, rel=1e-3)


def test_on_the_ground_it_stands_until_it_lifts_off():
    assert flown([HOVER * 0.9] * 4, 5, height=0.0).position_m == (0, 0, 0)
    assert flown([HOVER * 1.1] * 4, 5, height=0.0).position_m[2] < -1


def test_a_fall_ends_on_the_ground():
    body = flown([0.0] * 4, 10, height=-20.0)
    assert (body.position_m, body.velocity_mps) == ((0, 0, 0), (0, 0, 0))
    assert body.specific_force_mps2 == (0, 0, -GRAVITY_MPS2)


def test_who_lifts_off_as_it_touches_down_is_never_below_the_ground():
    body = Quadcopter()
    body.position_m, body.velocity_mps = (0.0, 0.0, -0.01), (3.0, 0.0, 2.0)
    for _ in range(10):
        body.step([HOVER * 1.05] * 4, STEP_S)
        assert body.position_m[2] <= 0


def sliding(heading=0.0):
    body = Quadcopter()
    body.attitude = (math.cos(heading / 2), 0.0, 0.0, math.sin(heading / 2))
    body.velocity_mps = (3.0, 0.0, 0.0)
    return body


def test_friction_stops_who_touches_down_in_flight():
    body = sliding()
    for _ in range(1000):
        body.step([0.0] * 4, STEP_S)
    assert body.velocity_mps == (0, 0, 0)
    way_m = 3.0**2 / (2 * quadcopter.FRICTION * GRAVITY_MPS2)
    assert body.position_m == pytest.approx((way_m, 0, 0), rel=0.1)  # drag stops it, too


@pytest.mark.parametrize(
    ("heading", "forward", "right"),
    [(0.0, -1, 0), (math.pi / 2, 0, 1), (-math.pi / 4, -(0.5**0.5), -(0.5**0.5))],
)
def test_it_feels_friction_along_its_own_axes(heading, forward, right):
    body = sliding(heading)
    body.step([0.0] * 4, STEP_S)
    brake = quadcopter.FRICTION * GRAVITY_MPS2 + 3.0 * quadcopter.DRAG_KGPS / quadcopter.MASS_KG
    assert body.specific_force_mps2 == pytest.approx((forward * brake, right * brake, -GRAVITY_MPS2))


def test_on_the_ground_no_wind_moves_it():
    body = flown([HOVER * 0.9] * 4, 5, height=0.0, wind=(8.0, -3.0, 0.0))
    assert (body.position_m, body.velocity_mps) == ((0, 0, 0), (0, 0, 0))
    assert body.specific_force_mps2 == (0, 0, -GRAVITY_MPS2)


MORE, LESS = HOVER * 1.02, HOVER * 0.98


@pytest.mark.parametrize(
    ("throttles", "axis"),
    [
        ([LESS, MORE, MORE, LESS], 0),  # left side up: it rolls to the right
        ([MORE, LESS, MORE, LESS], 1),  # front side up
        ([MORE, MORE, LESS, LESS], 2),  # counterclockwise propellers turn it clockwise
    ],
)
def test_which_motors_turn_it_which_way(throttles, axis):
    rates = flown(throttles, 0.1).rates_radps
    assert rates[axis] > 0.001
    assert [rate for other, rate in enumerate(rates) if other != axis] == pytest.approx([0, 0], abs=1e-4)


def test_rolled_to_the_right_it_goes_east():
    body = Quadcopter()
    body.position_m = (0.0, 0.0, HIGH_M)
    body.attitude = (math.cos(0.1), math.sin(0.1), 0.0, 0.0)
    body.step([HOVER] * 4, STEP_S)
    assert body.velocity_mps[1] == pytest.approx(GRAVITY_MPS2 * math.sin(0.2) * STEP_S)
    assert body.velocity_mps[0] == pytest.approx(0, abs=1e-12)


def test_the_wind_takes_it_along():
    body = flown([HOVER] * 4, 100, wind=(3.0, -2.0, 0.0))
    assert body.velocity_mps == pytest.approx((3, -2, 0), abs=1e-3)


throttles = strategies.lists(strategies.floats(0, 1), min_size=4, max_size=4)


@given(strategies.lists(throttles, min_size=1, max_size=30))
def test_whatever_the_motors_do_it_is_above_the_ground_and_turned_somehow(commands):
    body = Quadcopter()
    for command in commands:
        for _ in range(20):
            body.step(command, STEP_S)
        assert body.position_m[2] <= 0
        assert math.hypot(*body.attitude) == pytest.approx(1)
