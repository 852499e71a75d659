"""Flights with ArduPilot itself: `GRADYSIM_ARDUPILOT=path python -m pytest -m autopilot`.

Not among the usual tests: few machines have ArduPilot, and each test takes half a minute.
"""

import csv
import os
import socket
import struct
import threading

import pytest

from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand, SetVelocityMobilityCommand
from gradysim.protocol.plugin.mission_mobility import MissionMobilityConfiguration, MissionMobilityPlugin
from gradysim.simulator.handler.ardupilot_mobility import (
    ArdupilotMobilityConfiguration,
    ArdupilotMobilityHandler,
)
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from python.quiet_protocol import Quiet

pytestmark = pytest.mark.autopilot


@pytest.fixture(autouse=True)
def _there_is_one(tmp_path, monkeypatch):
    if not os.environ.get("GRADYSIM_ARDUPILOT"):
        pytest.fail("GRADYSIM_ARDUPILOT must name an arducopter program for SITL, or a checkout with one")
    monkeypatch.chdir(tmp_path)


class Tracked(Quiet):
    def initialize(self):
        self.track = []

    def handle_telemetry(self, telemetry):
        self.track.append((self.provider.current_time(), telemetry.current_position))

    def at(self, moment):
        return min(self.track, key=lambda sample: abs(sample[0] - moment))[1]


class Mission(Tracked):
    def initialize(self):
        super().initialize()
        self.mission = MissionMobilityPlugin(self, MissionMobilityConfiguration(speed=8, tolerance=1))
        self.mission.start_mission([(40, 0, 15), (40, 20, 15)])


class Drift(Tracked):
    def initialize(self):
        super().initialize()
        self.provider.schedule_timer("drift", 1)

    def handle_timer(self, timer):
        self.provider.send_mobility_command(SetVelocityMobilityCommand(0, -3, 0.5))


def flown(configuration, real_time):
    builder = SimulationBuilder(SimulationConfiguration(duration=40, real_time=real_time))
    builder.add_handler(TimerHandler()).add_handler(ArdupilotMobilityHandler(configuration))
    builder.add_node(Mission, (0, 0, 10))
    builder.add_node(Drift, (0, 50, 12))
    builder.add_node(Tracked, (0, 0, 0))
    simulator = builder.build()
    simulator.start_simulation()
    return [node.protocol_encapsulator.protocol for node in simulator.nodes]


@pytest.mark.parametrize("reference", [(-15.84, -47.92, 1000.0), (0, 0, 0)])
def test_a_mission_a_drift_and_a_node_on_the_ground(reference, tmp_path):
    configuration = ArdupilotMobilityConfiguration(
        reference_coordinates=reference, simulation_startup_speedup=10
    )
    mission, drift, ground = flown(configuration, real_time=4)
    assert mission.at(0) == pytest.approx((0, 0, 10), abs=1.5)
    assert mission.mission.is_idle
    assert mission.at(40) == pytest.approx((40, 20, 15), abs=2)
    moved = [b - a for a, b in zip(drift.at(20), drift.at(40), strict=True)]
    assert moved == pytest.approx([0, -60, 10], abs=12)
    assert ground.at(20) == pytest.approx((0, 0, 0), abs=1)
    with (tmp_path / "ardupilot_mobility_report.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [int(row["telemetry_requests"]) for row in rows] == [401, 401, 401]
    *in_the_air, on_the_ground = (float(row["battery_wasted"]) for row in rows)
    assert min(in_the_air) > on_the_ground


def on_simulated_time(**parameters):
    configuration = ArdupilotMobilityConfiguration(
        reference_coordinates=(-15.84, -47.92, 1000.0), autopilot_parameters=parameters
    )
    return flown(configuration, real_time=False)


def test_on_simulated_time_flights_are_exact_and_repeatable():
    mission, drift, ground = flights = on_simulated_time()
    assert mission.track[0] == (0.1, pytest.approx((0, 0, 10), abs=0.3))
    assert mission.mission.is_idle
    assert mission.at(40) == pytest.approx((40, 20, 15), abs=0.3)
    moved = [b - a for a, b in zip(drift.at(20), drift.at(40), strict=True)]
    assert moved == pytest.approx([0, -60, 10], abs=1)
    assert ground.at(20) == pytest.approx((0, 0, 0), abs=0.3)
    assert [each.track for each in on_simulated_time()] == [each.track for each in flights]


def test_nobody_flies_it_by_the_port_for_remote_control():
    """The port is open to all: 5501, plus ten for each instance. Channel 5 low is the mode STABILIZE."""
    undisturbed = on_simulated_time()[0].track
    has_landed = threading.Event()

    def disturb():
        orders = struct.pack("<16H", 1700, 1300, 1000, 1500, 1000, *[1500] * 11)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as remote:
            while not has_landed.wait(0.01):
                for instance in range(256):
                    remote.sendto(orders, ("127.0.0.1", 5501 + 10 * instance))

    thread = threading.Thread(target=disturb)
    thread.start()
    try:
        assert on_simulated_time()[0].track == undisturbed
    finally:
        has_landed.set()
        thread.join()


def test_on_simulated_time_it_stands_in_the_wind():
    mission, _, _ = on_simulated_time(SIM_WIND_SPD=6, SIM_WIND_DIR=90)
    assert mission.at(40) == pytest.approx((40, 20, 15), abs=1)


class OnOrder(Tracked):
    """Flies to places at given times."""

    targets = ((0.0, (20, 0, -1)), (300.0, (20, 15, 0)), (900.0, (0, 0, 10)))

    def initialize(self):
        super().initialize()
        for number, (time, _) in enumerate(self.targets):
            self.provider.schedule_timer(str(number), time)

    def handle_timer(self, timer):
        _, target = self.targets[int(timer)]
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(*target))


def test_on_simulated_time_it_stands_on_the_ground_for_long_and_flies_on():
    """With targets only, ArduCopter loses its position after ten minutes, and does not take off."""
    configuration = ArdupilotMobilityConfiguration(reference_coordinates=(0, 0, 0))
    builder = SimulationBuilder(SimulationConfiguration(duration=940))
    builder.add_handler(TimerHandler()).add_handler(ArdupilotMobilityHandler(configuration))
    builder.add_node(OnOrder, (0, 0, 10))
    builder.add_node(Tracked, (0, 50, 0))
    simulator = builder.build()
    simulator.start_simulation()
    visitor, ground = (node.protocol_encapsulator.protocol for node in simulator.nodes)
    assert visitor.at(290) == pytest.approx((20, 0, 0), abs=1)
    assert visitor.at(890) == pytest.approx((20, 15, 0), abs=1)
    assert visitor.at(940) == pytest.approx((0, 0, 10), abs=0.5)
    assert ground.at(940) == pytest.approx((0, 50, 0), abs=0.3)
