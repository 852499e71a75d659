import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.simulator.handler.mobility.dynamic_velocity.core import (
    apply_acceleration_limits,
    apply_velocity_limits,
    apply_velocity_tracking_first_order,
    integrate_position,
)

speeds = st.floats(-100, 100)
velocities = st.tuples(speeds, speeds, speeds)
limits = st.floats(0, 50)
steps = st.floats(1e-3, 10)

AT_REST = (0.0, 0.0, 0.0)


def change(before, after):
    return math.hypot(after[0] - before[0], after[1] - before[1]), abs(after[2] - before[2])


# Acceleration


def test_the_limit_in_the_plane_keeps_the_direction():
    assert apply_acceleration_limits(AT_REST, (3, 4, 5), 1, 1, 1) == pytest.approx((0.6, 0.8, 1))


def test_a_velocity_within_reach_is_reached_exactly():
    assert apply_acceleration_limits(AT_REST, (3.0, 4.0, -5.0), 1, 5, 5) == (3.0, 4.0, -5.0)


def test_without_a_limit_it_is_reached_at_once():
    assert apply_acceleration_limits(AT_REST, (3.0, 4.0, 5.0), 0.1, math.inf, math.inf) == (3.0, 4.0, 5.0)


@pytest.mark.parametrize("limit", [1.0, math.inf])
def test_in_no_time_nothing_changes(limit):
    assert apply_acceleration_limits(AT_REST, (3, 4, 5), 0, limit, limit) == AT_REST


@given(velocities, velocities, steps, limits, limits)
def test_the_acceleration_is_never_exceeded(current, desired, dt, limit_xy, limit_z):
    plane, vertical = change(current, apply_acceleration_limits(current, desired, dt, limit_xy, limit_z))
    assert plane <= limit_xy * dt + 1e-9
    assert vertical <= limit_z * dt + 1e-9


@pytest.mark.parametrize(
    ("arguments", "name"),
    [
        ((-1, 1, 1), "dt"),
        ((math.nan, 1, 1), "dt"),
        ((1, -1, 1), "max_acc_xy"),
        ((1, 1, math.nan), "max_acc_z"),
    ],
)
def test_wrong_arguments_of_acceleration(arguments, name):
    with pytest.raises(ValueError, match=name):
        apply_acceleration_limits(AT_REST, (1, 1, 1), *arguments)


# First order


def test_a_step_makes_up_for_its_share_of_the_difference():
    tracked = apply_velocity_tracking_first_order(AT_REST, (3, 4, 5), 0.1, 100, 100, 1, 0.5)
    assert tracked == pytest.approx((0.3, 0.4, 1.0))


def test_the_acceleration_is_limited_too():
    tracked = apply_velocity_tracking_first_order(AT_REST, (3, 4, 5), 0.1, 1, 1, 1, 1)
    assert tracked == pytest.approx((0.06, 0.08, 0.1))


def test_without_a_time_constant_only_the_acceleration_counts():
    tracked = apply_velocity_tracking_first_order(AT_REST, (3, 4, 5), 0.1, 100, 100, 1, None)
    assert tracked == pytest.approx((0.3, 0.4, 5))


def test_a_step_longer_than_the_time_constant_does_not_overshoot():
    tracked = apply_velocity_tracking_first_order(AT_REST, (3.0, 4.0, 5.0), 0.5, 100, 100, 0.1, 0.1)
    assert tracked == (3.0, 4.0, 5.0)


@given(velocities, velocities, steps, st.floats(0.01, 10))
def test_it_never_gets_farther_away(current, desired, dt, tau):
    tracked = apply_velocity_tracking_first_order(current, desired, dt, 1e6, 1e6, tau, tau)
    for before, after in zip(change(current, desired), change(tracked, desired), strict=True):
        assert after <= before + 1e-9


@pytest.mark.parametrize(
    ("arguments", "name"),
    [
        ((0, 1, 1, 1, 1), "dt"),
        ((-1, 1, 1, 1, 1), "dt"),
        ((1, -1, 1, 1, 1), "max_acc_xy"),
        ((1, 1, -1, 1, 1), "max_acc_z"),
        ((1, 1, 1, 0, 1), "tau_xy"),
        ((1, 1, 1, 1, -1), "tau_z"),
        ((1, 1, 1, math.nan, 1), "tau_xy"),
    ],
)
def test_wrong_arguments_of_first_order(arguments, name):
    with pytest.raises(ValueError, match=name):
        apply_velocity_tracking_first_order(AT_REST, (1, 1, 1), *arguments)


# Speed and position


def test_the_speed_limit_in_the_plane_keeps_the_direction():
    assert apply_velocity_limits((3, 4, -5), 1, 2) == pytest.approx((0.6, 0.8, -2))


@given(velocities, limits, limits)
def test_the_speed_is_never_exceeded(velocity, limit_xy, limit_z):
    x, y, z = apply_velocity_limits(velocity, limit_xy, limit_z)
    assert math.hypot(x, y) <= limit_xy + 1e-9
    assert abs(z) <= limit_z


@pytest.mark.parametrize(("arguments", "name"), [((-1, 1), "max_speed_xy"), ((1, math.nan), "max_speed_z")])
def test_wrong_arguments_of_speed(arguments, name):
    with pytest.raises(ValueError, match=name):
        apply_velocity_limits((1, 1, 1), *arguments)


def test_position_after_a_step():
    assert integrate_position((1, 2, 3), (1, 2, -4), 0.5) == (1.5, 3.0, 1.0)
