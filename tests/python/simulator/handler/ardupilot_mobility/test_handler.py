"""Simulations whose nodes are flown by processes that speak MAVLink: the toy of tests/python/sitl."""

import contextlib
import csv
import gc
import json
import logging
import math
import os
import signal
import socket
import subprocess
import sys
import threading
from pathlib import Path
from typing import ClassVar

import pytest

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    GotoGeoCoordsMobilityCommand,
    MobilityCommand,
    SetSpeedMobilityCommand,
    SetVelocityMobilityCommand,
)
from gradysim.protocol.position import geo_to_cartesian
from gradysim.simulator.handler.ardupilot_mobility import (
    ArdupilotMobilityConfiguration,
    ArdupilotMobilityException,
    ArdupilotMobilityHandler,
)
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from gradysim.sitl.dialect import load_dialect

REFERENCE = (-15.84, -47.92, 1000.0)
SPEED = 10


class Flyer(IProtocol):
    """Does `deeds[time](self)` at the times given, and keeps its telemetry."""

    deeds: ClassVar = {}

    def initialize(self):
        self.telemetry = []
        for moment in self.deeds:
            self.provider.schedule_timer(str(moment), moment)

    def handle_timer(self, timer):
        self.deeds[float(timer)](self)

    def handle_packet(self, message): ...

    def handle_telemetry(self, telemetry):
        self.telemetry.append((self.provider.current_time(), telemetry.current_position))

    def finish(self): ...

    def at(self, moment):
        """Where it was by its last telemetry before a time."""
        return [position for time, position in self.telemetry if time <= moment][-1]


def flyer(**deeds):
    """`flyer(at_2=command)`: a class of protocols that send commands."""
    chosen = {float(name.removeprefix("at_")): _sender(command) for name, command in deeds.items()}
    return type("Flyer", (Flyer,), {"deeds": chosen})


def _sender(command):
    if callable(command):
        return command
    return lambda protocol: protocol.provider.send_mobility_command(command)


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)


@pytest.fixture(autouse=True)
def _nothing_is_left_behind(tmp_path):
    threads = threading.active_count()
    yield
    gc.collect()
    assert list(tmp_path.glob("gradysim-sitl-*")) == []
    assert programs_in(tmp_path) == []
    assert threading.active_count() == threads


@pytest.fixture
def quick_answers(monkeypatch):
    monkeypatch.setattr("gradysim.sitl.vehicle._ANSWER_S", 0.2)


def programs_in(folder):
    """The command lines of running processes that name a folder."""
    found = []
    for file in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            line = file.read_bytes()
        except OSError:
            continue
        if str(folder).encode() in line and int(file.parent.name) != os.getpid():
            found.append(line)
    return found


def build(program, *protocols, positions=None, duration=5, real_time=SPEED, **settings):
    configuration = ArdupilotMobilityConfiguration(
        **{
            "ardupilot_path": program,
            "reference_coordinates": REFERENCE,
            "simulation_startup_speedup": 50,
            "autopilot_user": None,
            "uav_api_startup_timeout": 20,
            **settings,
        }
    )
    builder = SimulationBuilder(
        SimulationConfiguration(duration=duration, real_time=real_time, execution_logging=False)
    )
    builder.add_handler(TimerHandler())
    builder.add_handler(ArdupilotMobilityHandler(configuration))
    for number, protocol in enumerate(protocols):
        builder.add_node(protocol, positions[number] if positions else (10.0 * number, 5.0, 12.0))
    return builder.build()


def fly(*arguments, **settings):
    """Run a simulation to its end; return its protocols."""
    simulator = build(*arguments, **settings)
    simulator.start_simulation()
    return [node.protocol_encapsulator.protocol for node in simulator.nodes]


def near(position, within=1.5):
    return pytest.approx(position, abs=within)


# Flights


def test_every_node_is_in_the_air_at_its_place_when_the_simulation_starts(toy_copter):
    places = [(0, 0, 10), (30, -20, 15), (5, 5, 0)]
    for protocol, place in zip(
        fly(toy_copter(), *([Flyer] * 3), positions=places, duration=1), places, strict=True
    ):
        assert protocol.telemetry[0][0] == 0
        assert protocol.telemetry[0][1] == near(place)


def test_telemetry_comes_at_most_once_in_each_update(toy_copter):
    (protocol,) = fly(toy_copter(), Flyer, duration=5, update_rate=0.5)
    updates = [math.floor(moment / 0.5) for moment, _ in protocol.telemetry]
    assert updates == sorted(set(updates))
    assert len(updates) > 5


def test_x_is_north_and_y_is_east(toy_copter):
    (protocol,) = fly(toy_copter(), flyer(at_1=GotoCoordsMobilityCommand(60, -20, 18)), duration=12)
    assert protocol.at(12) == near((60, -20, 18))


def test_a_geographic_place_is_the_one_that_the_frame_gives_it(toy_copter):
    place = (-15.8395, -47.9197, 1020.0)
    (protocol,) = fly(toy_copter(), flyer(at_1=GotoGeoCoordsMobilityCommand(*place)), duration=12)
    assert protocol.at(12) == near(geo_to_cartesian(REFERENCE, place))


def test_without_reference_coordinates_nodes_fly_at_latitude_and_longitude_0(toy_copter):
    (protocol,) = fly(
        toy_copter(),
        flyer(at_1=GotoCoordsMobilityCommand(20, 0, 10), at_5=GotoCoordsMobilityCommand(0, 0, 10)),
        positions=[(0, 0, 10)],
        reference_coordinates=(0, 0, 0),
        duration=9,
    )
    assert (protocol.at(4.9), protocol.at(9)) == (near((20, 0, 10)), near((0, 0, 10)))


def final_state(program, identifier=0):
    """What the autopilot was doing at the end: target (north, east, up of its home), speed, velocity."""
    state = json.loads(program.with_name(f"final_{identifier}.json").read_text())
    assert state.pop("greetings") == 0, "ArduPilot takes a ground station that was there once for lost"
    return state


def test_the_default_speed_is_set(toy_copter):
    program = toy_copter()
    fly(program, flyer(at_0=GotoCoordsMobilityCommand(300, 5, 12)), duration=1, default_speed=7)
    assert final_state(program) == {"target": near([300, 0, 12], 0.1), "speed": 7, "velocity": None}


def test_a_speed_is_obeyed(toy_copter):
    tested = flyer(at_0=GotoCoordsMobilityCommand(300, 5, 12), at_1=SetSpeedMobilityCommand(20))
    program = toy_copter()
    fly(program, tested)
    assert final_state(program)["speed"] == 20


def test_at_speed_0_it_stands(toy_copter):
    tested = flyer(at_0=GotoCoordsMobilityCommand(300, 5, 12), at_1=SetSpeedMobilityCommand(0))
    program = toy_copter()
    fly(program, tested)
    assert final_state(program)["target"] is None


def test_after_speed_0_it_goes_on_with_the_next_speed(toy_copter):
    tested = flyer(
        at_0=SetSpeedMobilityCommand(0),
        at_1=GotoCoordsMobilityCommand(300, 5, 12),
        at_2=SetSpeedMobilityCommand(8),
    )
    program = toy_copter()
    fly(program, tested)
    assert final_state(program) == {"target": near([300, 0, 12], 0.1), "speed": 8, "velocity": None}


def test_a_velocity_is_held_until_told_otherwise(toy_copter):
    program = toy_copter()
    fly(program, flyer(at_0=SetVelocityMobilityCommand(3, -4, 1)), duration=10, real_time=8)
    assert final_state(program)["velocity"] == [3, -4, 1]


def test_after_a_velocity_the_speed_set_before_holds_again(toy_copter):
    tested = flyer(
        at_0=SetSpeedMobilityCommand(12),
        at_1=SetVelocityMobilityCommand(3, -4, 1),
        at_2=GotoCoordsMobilityCommand(300, 5, 12),
    )
    program = toy_copter()
    fly(program, tested)
    assert final_state(program) == {"target": near([300, 0, 12], 0.1), "speed": 12, "velocity": None}


def test_the_newest_target_counts(toy_copter):
    tested = flyer(
        at_1=GotoCoordsMobilityCommand(-500, 0, 12),
        **{"at_1.5": GotoCoordsMobilityCommand(20, 5, 12)},
    )
    (protocol,) = fly(toy_copter(), tested, duration=8)
    assert protocol.at(8) == near((20, 5, 12))


def test_an_autopilot_of_the_old_kind_flies_too(toy_copter):
    tested = flyer(at_1=GotoCoordsMobilityCommand(20, 5, 12))
    (protocol,) = fly(toy_copter({0: {"old": True}}), tested, duration=6)
    assert protocol.at(6) == near((20, 5, 12))


def test_commands_whose_answer_is_lost_are_repeated(toy_copter, quick_answers):
    (protocol,) = fly(toy_copter({0: {"loses_first": True}}), Flyer, duration=1)
    assert protocol.telemetry


# What goes wrong


def failure_of(*arguments, **settings):
    with pytest.raises(ArdupilotMobilityException) as caught:
        fly(*arguments, **settings)
    return str(caught.value)


def test_refused_arming_ends_it_with_the_reason_that_was_given(toy_copter):
    program = toy_copter({1: {"refuse_arming": True}})
    said = failure_of(program, Flyer, Flyer, uav_api_startup_timeout=2)
    assert said == (
        "node 1 (Flyer 1): arming: refused with MAV_RESULT_FAILED; "
        'the autopilot said: "PreArm: Compass not calibrated"'
    )


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"silent": True}, r"heartbeat: not done after 1 s; the autopilot said: nothing"),
        ({"exits": True}, r"start: the autopilot ended with status 3; it printed last: no such model"),
        ({"no_fix": True}, "position estimate: not done after 1 s; the autopilot said: nothing"),
        ({"deaf": True}, "telemetry: no answer after 5 tries; the autopilot said: nothing"),
    ],
)
def test_a_step_that_fails_is_named(toy_copter, wrong, said, quick_answers):
    text = failure_of(toy_copter({0: wrong}), Flyer, uav_api_startup_timeout=1)
    assert text.startswith("node 0 (Flyer 0): ")
    assert said in text


def test_death_in_mid_flight_ends_the_simulation_at_once(toy_copter):
    program = toy_copter({1: {"dies_at": 2}})
    simulator = build(program, Flyer, Flyer, duration=3600)
    with pytest.raises(ArdupilotMobilityException) as caught:
        simulator.start_simulation()
    assert str(caught.value) == (
        "node 1 (Flyer 1): the autopilot ended with status 7; it printed last: the battery exploded"
    )
    assert simulator.current_time < 3600


def test_death_before_the_start_is_noticed_too(toy_copter):
    said = failure_of(toy_copter({0: {"dies_at": "take-off"}}), Flyer)
    assert said.startswith("node 0 (Flyer 0): the autopilot ended with status 7")


def test_an_autopilot_that_leaves_the_mode_ends_the_simulation(toy_copter):
    said = failure_of(toy_copter({0: {"leaves_at": 2}}), Flyer, duration=3600)
    assert said == (
        "node 0 (Flyer 0): flight: it left mode GUIDED for mode number 9; "
        'the autopilot said: "Battery failsafe"'
    )


def test_an_autopilot_that_falls_silent_is_given_up(toy_copter, monkeypatch):
    monkeypatch.setattr("gradysim.simulator.handler.ardupilot_mobility.flight._SILENCE_S", 0.5)
    said = failure_of(toy_copter({0: {"hangs_at": 2}}), Flyer, duration=3600)
    assert said == "node 0 (Flyer 0): no position for 0.5 s of wall time"


def test_an_exception_of_a_protocol_passes_through(toy_copter):
    def fail(protocol):
        raise ZeroDivisionError("as it should")

    with pytest.raises(ZeroDivisionError, match="as it should"):
        fly(toy_copter(), flyer(at_1=fail), Flyer)


def test_autopilots_that_ignore_sigterm_are_killed(toy_copter):
    fly(toy_copter({0: {"stubborn": True}}), Flyer, Flyer, duration=1)


def test_ctrl_c_while_taking_off_leaves_nothing_behind(toy_copter):
    alarm = threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT))
    simulator = build(toy_copter({0: {"silent": True}}), Flyer)
    alarm.start()
    with pytest.raises(KeyboardInterrupt):
        simulator.start_simulation()
    alarm.join()


def test_ctrl_c_within_one_of_its_tasks_leaves_nothing_behind(toy_copter, monkeypatch):
    async def interrupted(vehicle, timeout_s):
        raise KeyboardInterrupt

    monkeypatch.setattr("gradysim.sitl.vehicle.Vehicle.meet", interrupted)
    with pytest.raises(KeyboardInterrupt):
        fly(toy_copter(), Flyer, Flyer)


def test_ctrl_c_in_flight_leaves_nothing_behind(toy_copter):
    finished = []
    tested = flyer(at_1=lambda protocol: signal.raise_signal(signal.SIGINT))
    tested.finish = lambda protocol: finished.append(protocol)
    simulator = build(toy_copter(), tested)
    with pytest.raises(KeyboardInterrupt):
        simulator.start_simulation()
    assert len(finished) == 1


def test_a_simulation_dropped_half_way_leaves_nothing_behind(toy_copter):
    simulator = build(toy_copter(), Flyer)
    simulator.run_events(3)
    del simulator
    gc.collect()


def test_who_seeks_no_real_time_is_told(toy_copter):
    with pytest.raises(ArdupilotMobilityException, match="set real_time=True"):
        build(toy_copter(), Flyer, real_time=False)
    gc.collect()


def test_without_pymavlink_the_error_says_what_to_install(toy_copter, monkeypatch):
    load_dialect.cache_clear()
    monkeypatch.setitem(sys.modules, "pymavlink.dialects.v20.ardupilotmega", None)
    with pytest.raises(ModuleNotFoundError, match=r'pip install "gradysim\[sitl\]"'):
        fly(toy_copter(), Flyer)


def test_without_an_autopilot_the_error_says_what_to_give(tmp_path):
    assert "there is no such file" in failure_of(tmp_path / "nothing", Flyer)


@pytest.mark.parametrize(
    ("command", "said"),
    [
        (GotoCoordsMobilityCommand(float("nan"), 0, 0), "expected three finite numbers"),
        (GotoCoordsMobilityCommand(0, 1e8, 0), "beyond the Earth's edge"),
        (GotoGeoCoordsMobilityCommand(91, 0, 0), "latitude 91"),
        (SetSpeedMobilityCommand(-1), "speed -1"),
        (SetVelocityMobilityCommand(1, None, 0), "expected three finite numbers"),
        (MobilityCommand(17), "unknown mobility command"),
    ],
)
def test_a_command_that_means_nothing_is_refused(toy_copter, command, said):
    text = failure_of(toy_copter(), flyer(at_0=command))
    assert text.startswith("node 0 was ")
    assert said in text


# The report


def rows(tmp_path):
    with (tmp_path / "ardupilot_mobility_report.csv").open() as file:
        return list(csv.DictReader(file))


def test_the_report_counts_telemetry_and_battery(toy_copter, tmp_path):
    protocols = fly(toy_copter(), Flyer, Flyer, duration=20)
    for identifier, row in enumerate(rows(tmp_path)):
        assert int(row["node_id"]) == identifier
        assert int(row["telemetry_requests"]) == 201
        received = len(protocols[identifier].telemetry)
        assert int(row["telemetry_drops"]) + received in (200, 201)
        assert 1 <= float(row["battery_wasted"]) <= 5


def test_what_comes_late_is_dropped_and_counted(toy_copter, tmp_path):
    (protocol,) = fly(toy_copter({0: {"hangs_at": 2}}), Flyer, duration=20)
    (row,) = rows(tmp_path)
    drops = int(row["telemetry_drops"])
    assert drops > 50
    assert drops + len(protocol.telemetry) in (200, 201)


def test_the_report_can_be_left_out(toy_copter, tmp_path):
    fly(toy_copter(), Flyer, duration=0.5, generate_report=False)
    assert list(tmp_path.glob("*.csv")) == []


# Settings


def test_what_autopilots_print_can_be_kept(toy_copter, tmp_path):
    failure_of(toy_copter({0: {"exits": True}}), Flyer, uav_api_log_path=tmp_path / "logs")
    assert (tmp_path / "logs/autopilot_0.log").read_text() == "no such model\n"


def test_what_autopilots_say_can_be_logged(toy_copter, caplog):
    caplog.set_level(logging.INFO)
    program = toy_copter({0: {"refuse_arming": True}})
    failure_of(program, Flyer, uav_api_log_console=True, uav_api_startup_timeout=1)
    assert "node 0 (Flyer 0) says: PreArm: Compass not calibrated" in caplog.messages


def test_the_environment_may_name_the_autopilot(toy_copter, monkeypatch):
    monkeypatch.setenv("GRADYSIM_ARDUPILOT", str(toy_copter()))
    assert fly(None, Flyer, duration=0.5)[0].telemetry


def test_a_handler_may_serve_one_simulation_after_another(toy_copter):
    simulator = build(toy_copter(), Flyer, duration=0.5)
    simulator.start_simulation()
    handler = simulator.nodes[0].protocol_encapsulator.provider.handlers["mobility"]
    builder = SimulationBuilder(
        SimulationConfiguration(duration=0.5, real_time=SPEED, execution_logging=False)
    )
    builder.add_handler(TimerHandler()).add_handler(handler)
    builder.add_node(Flyer, (0, 0, 10))
    again = builder.build()
    again.start_simulation()
    assert list(handler.nodes) == [0]
    assert again.nodes[0].position == near((0, 0, 10))


def test_what_starts_nothing_ends_nothing(toy_copter):
    """A vehicle that is there already flies, hears a ground station's heartbeats, and stays in the end."""
    program = toy_copter()
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port = probe.getsockname()[1]
    home = ",".join(map(str, (*REFERENCE, 0)))
    with vehicle(program, f"tcpserver:127.0.0.1:{port}", home) as process:
        (protocol,) = fly(
            None,
            flyer(at_0=GotoCoordsMobilityCommand(5, 5, 12)),
            positions=[(0, 0, 12)],
            real_time=1,
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
    """A vehicle that is not the simulation's, until its connection ends."""
    folder = program.parent / "vehicle"
    folder.mkdir()
    parameters = [
        "--speedup",
        "1",
        "--instance",
        "0",
        "--sysid",
        "7",
        "--defaults",
        "none",
        "--model",
        "quad",
    ]
    process = subprocess.Popen([program, *parameters, "--serial0", serial, "--home", home], cwd=folder)
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
    assert "km from its initial position: check reference_coordinates" in said


def test_every_node_needs_a_vehicle(toy_copter):
    with pytest.raises(ArdupilotMobilityException, match=r"node 1 has no vehicle: .* it has \[0\]"):
        build(None, Flyer, Flyer, simulate_drones=False, vehicle_addresses={0: "tcp:127.0.0.1:5760"})
    gc.collect()


def test_a_ground_station_sees_all_vehicles_and_may_command_them(toy_copter, monkeypatch):
    mavlink = load_dialect()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as station:
        station.bind(("127.0.0.1", 0))
        station.setblocking(False)
        monkeypatch.setattr(
            "gradysim.sitl.ground_station.open_ground_station.__defaults__", (station.getsockname()[1],)
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
    assert said.startswith("node 1 (Flyer 1): flight: it left mode GUIDED for mode number 9")
