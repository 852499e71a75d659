import math

import pytest

from gradysim.encapsulator.geo_target import geo_target
from gradysim.protocol.errors import MasslessMobilityException
from gradysim.protocol.messages.mobility import GotoGeoCoordsMobilityCommand
from gradysim.protocol.position import geo_to_cartesian

ORIGIN = (10.0, 20.0, 5.0)


RIO = (-22.9, -43.2, 0.0)


def test_a_target_is_relative_to_the_origin():
    command = GotoGeoCoordsMobilityCommand(10.001, 20.002, 7)
    assert geo_target(command, 3, ORIGIN) == geo_to_cartesian(ORIGIN, (10.001, 20.002, 7))


@pytest.mark.parametrize("wrong", [math.nan, math.inf, pytest.param(10**400, id="huge"), None, "5"])
@pytest.mark.parametrize("place", range(3))
def test_what_is_no_number_is_refused(wrong, place):
    target = [1.0, 2.0, 3.0]
    target[place] = wrong
    with pytest.raises(MasslessMobilityException, match=f"node 3 .*{wrong!r}.* three finite numbers"):
        geo_target(GotoGeoCoordsMobilityCommand(*target), 3, ORIGIN)


@pytest.mark.parametrize("latitude", [-90.1, 91])
def test_a_latitude_off_the_globe_is_refused(latitude):
    with pytest.raises(MasslessMobilityException, match=f"node 3 .*{latitude}.* -90 to 90 degrees"):
        geo_target(GotoGeoCoordsMobilityCommand(latitude, 0, 0), 3, ORIGIN)


def test_latitude_and_longitude_exchanged_are_refused():
    with pytest.raises(MasslessMobilityException) as raised:
        geo_target(GotoGeoCoordsMobilityCommand(-43.2001, -22.9001, 10), 3, RIO)
    assert str(raised.value) == (
        "node 3 was sent to latitude -43.2001, longitude -22.9001, altitude 10, which is 3068 km from the"
        " origin of the scene; expected latitude before longitude: did you mean latitude -22.9001, longitude"
        " -43.2001?"
    )


def test_they_are_refused_close_to_the_diagonal_too():
    with pytest.raises(MasslessMobilityException, match=r"991 km .* latitude 39.92, longitude 32.86\?"):
        geo_target(GotoGeoCoordsMobilityCommand(32.86, 39.92, 10), 3, (39.93, 32.85, 0))


@pytest.mark.parametrize(
    ("place", "origin"),
    [
        ((-43.2, -22.9, 10), ORIGIN),  # far away both ways
        ((-22.9, -43.2, 10), RIO),
        ((-23.9, -43.2, 10), RIO),  # 111 km
        ((10.1, 9.9, 0), (10.0, 10.0, 0.0)),  # near both ways
        ((46.42, 45.05, 0), (45.03, 46.24, 0.0)),  # 181 km, across the diagonal
        ((36.54, 39.07, 0), (38.69, 36.08, 0.0)),  # 353 km, and 52 km the other way
        ((5.0, 100.0, 0), ORIGIN),  # no latitude
    ],
)
def test_other_places_are_not_doubted(place, origin):
    assert geo_target(GotoGeoCoordsMobilityCommand(*place), 3, origin) == geo_to_cartesian(origin, place)


@pytest.mark.parametrize("place", [(0, 160, 0), (10, 20, 1e8)])
def test_a_place_outside_of_the_scene_is_refused(place):
    with pytest.raises(
        MasslessMobilityException, match=r"km from the origin.*at most 10000000 m on each axis"
    ):
        geo_target(GotoGeoCoordsMobilityCommand(*place), 3, ORIGIN)
