import math

import pytest

from gradysim.encapsulator.geo_target import geo_target
from gradysim.protocol.errors import MasslessMobilityException
from gradysim.protocol.messages.mobility import GotoGeoCoordsMobilityCommand
from gradysim.protocol.position import geo_to_cartesian

ORIGIN = (10.0, 20.0, 5.0)


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
