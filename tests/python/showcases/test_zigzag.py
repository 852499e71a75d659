"""ZigzagProtocol: UAVs that meet exchange data, and turn around."""

from python.showcases.conftest import Ran

LINES = """
*.numUavs = 2
*.uavs[*].protocol.class = "gradysim.showcases:ZigzagProtocol"
*.uavs[*].protocol.mission = "0 0 20, 300 0 20, back"
*.uavs[1].protocol.takeoff_time = 45s
*.uavs[*].mobility.speed = 10mps
*.uavs[*].mobility.telemetryInterval = 100ms
*.sensor.protocol.class = "gradysim.showcases:ZigzagProtocolSensor"
*.sensor.mobility.initialX = 300m
"""
"""uavs[0] has been at the sensor when it meets uavs[1], which comes from the origin."""

GROUND = """
*.groundStation.protocol.class = "gradysim.showcases:ZigzagProtocol"
*.groundStation.mobility.initialX = -40m
"""


def test_the_data_goes_to_the_uav_nearer_to_the_start(ran: Ran) -> None:
    far, near = (ran(LINES, limit_s=40)[f"uavs[{index}]"].tracked_variables["data_load"] for index in (0, 1))
    assert (far > 0, near) == (True, 0)
    nodes = ran(LINES, limit_s=56)
    assert [nodes[f"uavs[{index}]"].tracked_variables["data_load"] for index in (0, 1)] == [0, far]


def test_both_turn_around(ran: Ran) -> None:
    before, after = (
        [ran(LINES, limit_s=limit)[f"uavs[{index}]"].position[0] for index in (0, 1)] for limit in (56, 60)
    )
    assert after[0] > before[0]
    assert after[1] < before[1]


def test_the_ground_station_takes_the_data(ran: Ran) -> None:
    nodes = ran(LINES + GROUND, limit_s=75)
    assert nodes["uavs[1]"].tracked_variables["data_load"] == 0
    assert nodes["groundStation"].tracked_variables["data_load"] > 0
