"""SimpleDroneProtocol: what the UAV brings from the sensor to the ground station."""

import pytest

from python.showcases.conftest import Ran

LINES = """
*.uav.protocol.class = "gradysim.showcases:SimpleDroneProtocol"
*.uav.protocol.mission = "0 0 20, 200 0 20, back"
*.uav.mobility.speed = 10mps
*.uav.mobility.telemetryInterval = 100ms
*.sensor.protocol.class = "gradysim.showcases:SimpleSensorProtocol"
*.sensor.mobility.initialX = 200m
*.groundStation.protocol.class = "gradysim.showcases:SimpleGroundProtocol"
"""
"""The UAV is node 0, the sensor node 1, the ground station node 2."""


def data(ran: Ran, lines: str = "", limit_s: float = 60) -> dict[str, int]:
    nodes = ran(LINES + lines, limit_s)
    return {name: nodes[name].tracked_variables["data_load"] for name in ("uav", "groundStation")}


def test_a_uav_collects_and_delivers(ran: Ran) -> None:
    collected = data(ran, limit_s=25)
    assert collected["groundStation"] == 0
    assert collected["uav"] > 0
    assert collected["uav"] % 5 == 0
    delivered = data(ran)
    assert delivered["uav"] == 0
    assert delivered["groundStation"] > collected["uav"]


def test_a_timeout_limits_exchanges(ran: Ran) -> None:
    assert data(ran, "*.uav.protocol.timeout_duration = 100s", limit_s=25)["uav"] == 5
    assert (
        data(ran, "*.sensor.protocol.payload_size = 7\n*.uav.protocol.timeout_duration = 100s", 25)["uav"]
        == 7
    )


@pytest.mark.parametrize(("hears", "uav"), [("1 2", True), ("2", False)])
def test_a_uav_hears_whom_it_shall(ran: Ran, hears: str, uav: bool) -> None:
    assert (data(ran, f'*.uav.protocol.hears = "{hears}"', limit_s=25)["uav"] > 0) is uav
