"""Mobility commands for a vehicle with an autopilot."""

import pytest

from gradysim.protocol.errors import MasslessMobilityException
from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    GotoGeoCoordsMobilityCommand,
    MobilityCommand,
    SetSpeedMobilityCommand,
    SetVelocityMobilityCommand,
)
from gradysim.protocol.position import geo_to_cartesian
from gradysim.sitl.flight_orders import give_order

REFERENCE = (-15.84, -47.92, 1000.0)


class Vehicle:
    def __init__(self, edge_m=1e6):
        self.orders = []
        self.edge_m = edge_m

    def go_to(self, target):
        if target[0] > self.edge_m:
            raise ValueError("Earth")
        self.orders.append(("go_to", target))

    def set_speed(self, speed_mps):
        if 0 < speed_mps < 0.5:
            raise ValueError("it stalls")
        self.orders.append(("set_speed", speed_mps))

    def set_velocity(self, velocity_mps):
        self.orders.append(("set_velocity", velocity_mps))


def ordered(command):
    vehicle = Vehicle()
    give_order(command, 3, REFERENCE, vehicle)
    (order,) = vehicle.orders
    return order


@pytest.mark.parametrize(
    ("command", "order"),
    [
        (GotoCoordsMobilityCommand(1, 2, 3), ("go_to", (1, 2, 3))),
        (SetSpeedMobilityCommand(0), ("set_speed", 0)),
        (MobilityCommand(3, 5, 0, 0), ("set_speed", 5)),
        (SetVelocityMobilityCommand(1, -2, 0.5), ("set_velocity", (1, -2, 0.5))),
        (SetVelocityMobilityCommand(5, 0, 0), ("set_velocity", (5, 0, 0))),
    ],
)
def test_each_command_is_one_order(command, order):
    assert ordered(command) == order


def test_a_geographic_place_is_one_of_the_frame():
    place = (-15.839, -47.919, 1020.0)
    kind, target = ordered(GotoGeoCoordsMobilityCommand(*place))
    assert (kind, target) == ("go_to", pytest.approx(geo_to_cartesian(REFERENCE, place)))


@pytest.mark.parametrize(
    ("command", "value"),
    [
        (GotoCoordsMobilityCommand(float("nan"), 0, 0), "(nan, 0, 0)"),
        (GotoCoordsMobilityCommand(2e6, 0, 0), "Earth"),
        (SetVelocityMobilityCommand(1, None, 0), "(1, None, 0)"),
        (SetSpeedMobilityCommand(-1), "-1"),
        (SetSpeedMobilityCommand(0.25), "0.25: "),
        (MobilityCommand(17), "17"),
        ("north", "'north'"),
    ],
)
def test_an_invalid_command_is_refused_with_its_value(command, value):
    vehicle = Vehicle()
    with pytest.raises(MasslessMobilityException) as caught:
        give_order(command, 3, REFERENCE, vehicle)
    assert value in str(caught.value)
    assert vehicle.orders == []
