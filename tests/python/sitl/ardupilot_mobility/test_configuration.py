import pytest

from gradysim.simulator.handler.ardupilot_mobility import (
    ArdupilotMobilityConfiguration,
    ArdupilotMobilityHandler,
)


@pytest.mark.parametrize(
    "name",
    [
        "update_rate",
        "default_speed",
        "uav_api_startup_timeout",
        "simulation_startup_speedup",
        "mavlink_streamrate",
    ],
)
@pytest.mark.parametrize("value", [0, -1, float("nan"), float("inf"), "1", None])
def test_a_number_that_is_none_is_refused(name, value):
    with pytest.raises(ValueError, match=f"^{name} "):
        ArdupilotMobilityConfiguration(**{name: value})


def test_a_speed_that_arducopter_ignores_is_refused():
    with pytest.raises(ValueError, match=r"^default_speed .*0\.2 m/s.* got 0\.1$"):
        ArdupilotMobilityConfiguration(default_speed=0.1)
    assert ArdupilotMobilityConfiguration(default_speed=0.2).default_speed == 0.2


@pytest.mark.parametrize("place", [(91, 0, 0), (0, 0), None, (0, float("nan"), 0)])
def test_a_place_that_is_none_is_refused(place):
    with pytest.raises(ValueError, match=r"^reference_coordinates "):
        ArdupilotMobilityConfiguration(reference_coordinates=place)


@pytest.mark.parametrize("value", [float("nan"), "1", None, True])
def test_a_parameter_that_is_no_number_is_refused(value):
    with pytest.raises(ValueError, match="SIM_WIND_SPD"):
        ArdupilotMobilityConfiguration(autopilot_parameters={"SIM_WIND_SPD": value})


def test_an_address_that_is_none_is_refused():
    with pytest.raises(ValueError, match=r"10\.0\.0\.2"):
        ArdupilotMobilityConfiguration(vehicle_addresses={0: "10.0.0.2"})


def test_a_handler_takes_no_other_configuration():
    with pytest.raises(TypeError, match="ArdupilotMobilityConfiguration"):
        ArdupilotMobilityHandler({"update_rate": 1})
