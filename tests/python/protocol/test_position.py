import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.position import geo_to_cartesian, rotate_position_2d, squared_distance

METRES_PER_DEGREE = math.pi * 6_371_000 / 180

coordinates = st.floats(-1e6, 1e6)
positions = st.tuples(coordinates, coordinates, coordinates)


def test_squared_distance():
    assert squared_distance((1, 2, 3), (2, 4, 6)) == 14


@given(positions, positions)
def test_squared_distance_is_symmetric(a, b):
    assert squared_distance(a, b) == squared_distance(b, a)


@pytest.mark.parametrize(
    ("target", "signs"),
    [
        ((10.001, 10.001), (1, 1)),
        ((10.001, 9.999), (1, -1)),
        ((9.999, 10.001), (-1, 1)),
        ((9.999, 9.999), (-1, -1)),
    ],
)
def test_north_is_positive_x_and_east_is_positive_y(target, signs):
    x, y, _ = geo_to_cartesian((10, 10, 0), (*target, 0))
    assert (math.copysign(1, x), math.copysign(1, y)) == signs


def test_north_is_the_length_of_the_meridian():
    assert geo_to_cartesian((0, 0, 0), (1, 0, 0)) == pytest.approx((METRES_PER_DEGREE, 0, 0))


def test_east_shrinks_with_the_latitude():
    expected = 0.001 * METRES_PER_DEGREE * math.cos(math.radians(60))
    assert geo_to_cartesian((60, 0, 0), (60, 0.001, 0)) == pytest.approx((0, expected, 0))


def test_up_is_the_difference_of_altitudes():
    assert geo_to_cartesian((5, 5, 100), (5, 5, 70)) == (0, 0, -30)


def test_the_date_line_is_crossed_the_short_way():
    x, y, _ = geo_to_cartesian((0, 179.9, 0), (0, -179.9, 0))
    assert (x, y) == pytest.approx((0, 0.2 * METRES_PER_DEGREE))


@given(st.floats(-80, 80), st.floats(-179, 179), st.floats(-0.01, 0.01), st.floats(-0.01, 0.01))
def test_nearby_points_lie_on_the_tangent_plane(latitude, longitude, north_deg, east_deg):
    x, y, _ = geo_to_cartesian((latitude, longitude, 0), (latitude + north_deg, longitude + east_deg, 0))
    assert x == pytest.approx(north_deg * METRES_PER_DEGREE, abs=1e-3)
    assert y == pytest.approx(east_deg * METRES_PER_DEGREE * math.cos(math.radians(latitude)), abs=1e-3)


def test_rotation_is_from_x_towards_y():
    assert rotate_position_2d((1, 0, 5), 90) == pytest.approx((0, 1, 5))


@given(positions, st.floats(-720, 720))
def test_rotation_keeps_the_distance_from_the_axis(position, angle):
    x, y, z = rotate_position_2d(position, angle)
    assert math.hypot(x, y) == pytest.approx(math.hypot(position[0], position[1]), abs=1e-6)
    assert z == position[2]
