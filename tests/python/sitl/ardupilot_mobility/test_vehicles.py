"""Vehicles that the simulation does not start, and ground stations that watch."""

import contextlib
import gc
import json
import socket
import subprocess

import pytest

from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
)
from gradysim.simulator.handler.ardupilot_mobility import (
    ArdupilotMobilityException,
)
from gradysim.sitl.mavlink import load_dialect
from python.sitl.ardupilot_mobility.flying import (
    REFERENCE,
    SPEED,
    Flyer,
    build,
    failure_of,
    fly,
    flyer,
    near,
)


def test_a_running_vehicle_is_flown_and_not_ended(toy_copter, monkeypatch):
    """It gets the heartbeats of a ground station."""
    monkeypatch.setattr("gradysim.sitl.ardupilot_mobility.real_time._HEARTBEAT_S", 0.1)
    program = toy_copter()
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port = probe.getsockname()[1]
    home = ",".join(map(str, (*REFERENCE, 0)))
    with vehicle(program, f"tcpserver:127.0.0.1:{port}", home) as process:
        (protocol,) = fly(
            None,
            flyer(at_0=GotoCoordsMobilityCommand(5, 5, 12)),
            positions=[(0, 0, 12)],
            duration=3,
            simulate_drones=False,
            vehicle_addresses={0: f"tcp:127.0.0.1:{port}"},
        )
        assert protocol.telemetry[0][1] == near((0, 0, 12))
    assert process.returncode == 0
    state = json.loads(program.with_name("final_vehicle.json").read_text())
    assert state["target"] == near([5, 5, 12], 0.1)
    assert state["greetings"] > 1


@contextlib.contextmanager
def vehicle(program, serial, home):
    """Return a vehicle that the simulation does not start, at the pace of the simulation."""
    folder = program.parent / "vehicle"
    folder.mkdir()
    options = f"--speedup {SPEED} --instance 0 --sysid 7 --defaults /dev/null --model quad".split()
    process = subprocess.Popen([program, *options, "--serial0", serial, "--home", home], cwd=folder)
    try:
        yield process
        process.wait(timeout=10)
    finally:
        process.kill()
        process.wait()


def test_a_vehicle_far_from_its_place_is_refused(toy_copter):
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port = probe.getsockname()[1]
    with vehicle(toy_copter(), f"tcpserver:127.0.0.1:{port}", "10,10,0,0"):
        said = failure_of(None, Flyer, simulate_drones=False, vehicle_addresses={0: f"tcp:127.0.0.1:{port}"})
    assert "reference_coordinates" in said


def test_every_node_needs_a_vehicle(toy_copter):
    with pytest.raises(ArdupilotMobilityException, match=r"node 1 .*vehicle_addresses"):
        build(None, Flyer, Flyer, simulate_drones=False, vehicle_addresses={0: "tcp:127.0.0.1:5760"})
    gc.collect()


@pytest.mark.verify
@pytest.mark.parametrize("old", [False, True])
def test_a_ground_station_does_not_change_how_often_nodes_get_telemetry(toy_copter, monkeypatch, old):
    mavlink = load_dialect()
    monkeypatch.setattr("gradysim.sitl.ardupilot_mobility.real_time._RESTORE_S", 0.1)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as station:
        station.bind(("127.0.0.1", 0))
        monkeypatch.setattr(
            "gradysim.sitl.connection.open_ground_station.__defaults__", (station.getsockname()[1],)
        )
        codec = mavlink.MAVLink(None, srcSystem=254, srcComponent=190)

        def ask_for_few(protocol):
            order = mavlink.MAVLink_request_data_stream_message(1, 1, mavlink.MAV_DATA_STREAM_POSITION, 1, 1)
            station.sendto(order.pack(codec), station.recvfrom(65536)[1])

        (protocol,) = fly(
            toy_copter({0: {"old": old}}),
            flyer(at_1=ask_for_few),
            duration=13,
            real_time=2,
            ground_station_ip="127.0.0.1",
        )
    late = [moment for moment, _ in protocol.telemetry if moment > 3]
    assert len(late) > 50


def test_a_ground_station_sees_all_vehicles_and_may_command_them(toy_copter, monkeypatch):
    mavlink = load_dialect()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as station:
        station.bind(("127.0.0.1", 0))
        station.setblocking(False)
        monkeypatch.setattr(
            "gradysim.sitl.connection.open_ground_station.__defaults__", (station.getsockname()[1],)
        )
        codec = mavlink.MAVLink(None, srcSystem=254, srcComponent=190)
        codec.robust_parsing = True
        seen = {}

        def look(protocol):
            with contextlib.suppress(BlockingIOError):
                while True:
                    data, address = station.recvfrom(65536)
                    for message in codec.parse_buffer(data) or ():
                        seen[message.get_srcSystem()] = address

        def land(protocol):
            look(protocol)
            order = mavlink.MAVLink_set_mode_message(2, mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED, 9)
            station.sendto(order.pack(codec), seen[2])

        said = failure_of(toy_copter(), flyer(at_2=land), Flyer, duration=3600, ground_station_ip="127.0.0.1")
    assert set(seen) == {1, 2}
    assert said.startswith("node 1 (Flyer 1): ")
    assert " 9" in said
