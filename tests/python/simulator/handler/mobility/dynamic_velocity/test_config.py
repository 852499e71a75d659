import math

import pytest

from gradysim.simulator.handler.mobility import DynamicVelocityMobilityConfiguration

RIGHT = {"update_rate": 0.1, "max_speed_xy": 10, "max_speed_z": 5, "max_acc_xy": 2, "max_acc_z": 1}


def test_the_defaults_are_the_published_ones():
    configuration = DynamicVelocityMobilityConfiguration(0.1, 10, 5, 2, 1)
    assert configuration == DynamicVelocityMobilityConfiguration(
        **RIGHT, tau_xy=None, tau_z=None, send_telemetry=True, telemetry_decimation=1
    )


@pytest.mark.parametrize(
    "right", [{"max_speed_xy": 0}, {"max_acc_z": math.inf}, {"tau_xy": 0.5}, {"telemetry_decimation": 3}]
)
def test_right_values(right):
    DynamicVelocityMobilityConfiguration(**RIGHT | right)


@pytest.mark.parametrize(
    "wrong",
    [
        {"update_rate": 0},
        {"update_rate": math.inf},
        {"update_rate": "0.1"},
        {"max_speed_xy": -1},
        {"max_speed_z": math.nan},
        {"max_acc_xy": None},
        {"max_acc_z": -0.1},
        {"tau_xy": 0},
        {"tau_z": -1},
        {"telemetry_decimation": 0},
        {"telemetry_decimation": 1.5},
        {"telemetry_decimation": True},
    ],
)
def test_wrong_values_are_refused_by_name(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        DynamicVelocityMobilityConfiguration(**RIGHT | wrong)
