import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.position import geo_to_cartesian
from gradysim.sitl.frame import autopilots_coordinates, cartesian_to_geo, home_of, off_null_island

references = st.tuples(st.floats(-80, 80), st.floats(-180, 180), st.floats(-100, 5000))
points = st.tuples(*[st.floats(-100_000, 100_000)] * 2, st.floats(-1000, 10_000))


@given(references, points)
def test_it_is_the_way_back_from_geo_to_cartesian(reference, point):
    assert geo_to_cartesian(reference, cartesian_to_geo(reference, point)) == pytest.approx(point, abs=1e-5)


def test_x_is_north_and_y_is_east():
    latitude, longitude, altitude = cartesian_to_geo((10, 20, 100), (1000, 2000, 30))
    assert latitude > 10
    assert longitude > 20
    assert altitude == 130


def test_it_goes_on_beyond_the_180th_meridian():
    assert cartesian_to_geo((0, 179.9999, 0), (0, 1000, 0))[1] == pytest.approx(-179.991107, abs=1e-5)


@pytest.mark.parametrize("point", [(2e7, 0, 0), (0, 3e7, 0)])
def test_who_leaves_the_earth_is_told(point):
    with pytest.raises(ValueError, match="Earth"):
        cartesian_to_geo((45, 0, 0), point)


def test_home_is_on_the_ground_below():
    assert home_of((10, 20, 100), (0, 0, 50)) == pytest.approx((10, 20, 100))


@pytest.mark.parametrize("place", [(0.0, 0.0), (-1e-9, 4e-8)])
def test_null_island_is_avoided(place):
    assert off_null_island(*place) == (1e-7, 0.0)


@pytest.mark.parametrize("place", [(1e-7, 0.0), (0.0, -2e-7), (-15.84, -47.92)])
def test_all_other_places_stay(place):
    assert off_null_island(*place) == place


def test_an_autopilots_earth_is_flat_and_a_little_larger():
    home = (60.0, 30.0, 100.0)
    latitude, longitude, height = autopilots_coordinates(home, (1000.0, -1000.0, 20.0))
    degree_m = math.pi / 180 * 6_378_100
    assert (latitude - 60.0) * degree_m == pytest.approx(1000)
    assert (longitude - 30.0) * degree_m / 2 == pytest.approx(-1000)
    assert height == 20.0
    assert autopilots_coordinates(home, (0.0, 0.0, 0.0)) == pytest.approx((60.0, 30.0, 0.0))


@pytest.mark.parametrize(("longitude", "east_m"), [(179.9998, 60.0), (-179.9998, -60.0)])
def test_it_ends_at_the_date_line(longitude, east_m):
    assert autopilots_coordinates((0.0, longitude, 0.0), (0.0, -east_m, 5.0))[2] == 5.0
    with pytest.raises(ValueError, match="date"):
        autopilots_coordinates((0.0, longitude, 0.0), (0.0, east_m, 5.0))
