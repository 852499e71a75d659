"""DadcaProtocol: UAVs divide the tour, and no data gets lost where no message does."""

from python.showcases.conftest import Ran

LINES = """
*.numUavs = 2
*.uavs[*].protocol.class = "gradysim.showcases:DadcaProtocol"
*.uavs[*].protocol.mission = "0 0 20, 200 0 20, 400 0 20"
*.uavs[1].protocol.takeoff_time = 30s
*.uavs[*].mobility.speed = 10mps
*.uavs[*].mobility.telemetryInterval = 100ms
*.numSensors = 2
*.sensors[*].protocol.class = "gradysim.showcases:DadcaProtocolSensor"
*.sensors[*].protocol.start_time = 0s
*.sensors[0].mobility.initialX = 100m
*.sensors[1].mobility.initialX = 400m
*.groundStation.protocol.class = "gradysim.showcases:DadcaProtocolGround"
*.groundStation.mobility.initialX = -40m
"""


def test_each_uav_flies_on_its_half(ran: Ran) -> None:
    xs = [
        [ran(LINES, limit_s=limit)[f"uavs[{index}]"].position[0] for limit in range(100, 180, 10)]
        for index in (0, 1)
    ]
    assert (min(xs[0]) > 195, max(xs[1]) < 205) == (True, True)
    assert max(xs[0]) > 300
    assert min(xs[1]) < 100


def test_all_packets_are_somewhere(ran: Ran) -> None:
    nodes = ran(LINES, limit_s=301)
    assert sum(node.tracked_variables["data_load"] for node in nodes.values()) == 2 * 300 / 5
    assert nodes["groundStation"].tracked_variables["data_load"] > 60


def test_a_uav_has_room_for_so_many(ran: Ran) -> None:
    nodes = ran(f"{LINES}*.uavs[*].protocol.packet_limit = 3", limit_s=301)
    assert max(nodes[f"uavs[{index}]"].tracked_variables["data_load"] for index in (0, 1)) <= 3
