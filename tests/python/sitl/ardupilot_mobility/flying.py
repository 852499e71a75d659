"""Simulations with nodes flown by processes that speak MAVLink: the toy of tests/python/sitl."""

import os
import time
from pathlib import Path
from typing import ClassVar

import pytest

from gradysim.simulator.handler.ardupilot_mobility import (
    ArdupilotMobilityConfiguration,
    ArdupilotMobilityException,
    ArdupilotMobilityHandler,
)
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from python.quiet_protocol import Quiet

REFERENCE = (-15.84, -47.92, 1000.0)


SPEED = 10


class Flyer(Quiet):
    """Calls `deeds[time](self)` at the given times, and records its telemetry."""

    deeds: ClassVar = {}

    def initialize(self):
        self.telemetry = []
        for moment in self.deeds:
            self.provider.schedule_timer(str(moment), moment)

    def handle_timer(self, timer):
        self.deeds[float(timer)](self)

    def handle_telemetry(self, telemetry):
        self.telemetry.append((self.provider.current_time(), telemetry.current_position))

    def at(self, moment):
        """Return its position in the last telemetry before a time."""
        return [position for time, position in self.telemetry if time <= moment][-1]


def flyer(**deeds):
    """`flyer(at_2=command)`: a class of protocols that send commands."""
    chosen = {float(name.removeprefix("at_")): _sender(command) for name, command in deeds.items()}
    return type("Flyer", (Flyer,), {"deeds": chosen})


def _sender(command):
    if callable(command):
        return command
    return lambda protocol: protocol.provider.send_mobility_command(command)


def programs_in(folder):
    """Return the command lines of running processes that name a directory."""
    found = []
    for file in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            line = file.read_bytes()
        except OSError:
            continue
        if str(folder).encode() in line and int(file.parent.name) != os.getpid():
            found.append(line)
    return found


def programs_left_in(folder):
    """Return the same, after a moment if there are any: the kernel may need time to end killed processes."""
    for _ in range(500):
        if not programs_in(folder):
            break
        time.sleep(0.01)
    return programs_in(folder)


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


def failure_of(*arguments, **settings):
    with pytest.raises(ArdupilotMobilityException) as caught:
        fly(*arguments, **settings)
    return str(caught.value)
