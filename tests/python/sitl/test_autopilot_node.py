"""The environment of an autopilot on simulated time."""

import pytest

from gradysim.sitl import SitlError
from gradysim.sitl.autopilot_node import ground_temperature, wind_mps


@pytest.mark.parametrize(
    ("parameters", "wind"),
    [
        ({}, (0, 0, 0)),
        ({"SIM_WIND_SPD": 5.0}, (5, 0, 0)),
        ({"SIM_WIND_SPD": 5.0, "SIM_WIND_DIR": 0.0}, (-5, 0, 0)),
        ({"SIM_WIND_SPD": 5.0, "SIM_WIND_DIR": 90.0}, (0, -5, 0)),
    ],
)
def test_a_wind_is_named_by_where_it_comes_from(parameters, wind):
    assert wind_mps("vehicle 0", parameters) == pytest.approx(wind, abs=1e-9)


def test_a_wind_that_would_not_blow_is_refused():
    with pytest.raises(SitlError, match=r"vehicle 0: .*SIM_WIND_TURB"):
        wind_mps("vehicle 0", {"SIM_WIND_SPD": 5.0, "SIM_WIND_TURB": 1.0})


def test_autopilots_are_told_how_warm_it_is_at_home():
    assert set(ground_temperature(0.0).values()) == {15.0}
    assert set(ground_temperature(1000.0).values()) == {8.5}
