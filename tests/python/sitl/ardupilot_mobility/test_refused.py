"""Rejected arguments and commands."""

import gc
import sys

import pytest

from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    GotoGeoCoordsMobilityCommand,
    MobilityCommand,
    SetSpeedMobilityCommand,
    SetVelocityMobilityCommand,
)
from gradysim.simulator.handler.ardupilot_mobility import (
    ArdupilotMobilityException,
)
from gradysim.sitl.mavlink import load_dialect
from python.sitl.ardupilot_mobility.flying import Flyer, build, failure_of, fly, flyer


@pytest.mark.parametrize(
    "settings",
    [{"simulate_drones": False, "vehicle_addresses": {0: "tcp:h:1"}}, {"ground_station_ip": "127.0.0.1"}],
)
def test_who_needs_real_time_is_told(toy_copter, settings):
    with pytest.raises(ArdupilotMobilityException, match="real_time=True"):
        build(toy_copter(), Flyer, real_time=False, **settings)
    gc.collect()


def test_without_pymavlink_the_error_says_what_to_install(toy_copter, monkeypatch):
    load_dialect.cache_clear()
    monkeypatch.setitem(sys.modules, "pymavlink.dialects.v20.ardupilotmega", None)
    with pytest.raises(ModuleNotFoundError, match=r"pip.*pymavlink"):
        fly(toy_copter(), Flyer)


def test_without_an_autopilot_the_error_says_what_to_give(tmp_path):
    assert str(tmp_path / "nothing") in failure_of(tmp_path / "nothing", Flyer)


def test_a_node_below_the_ground_is_refused_before_take_off(toy_copter):
    said = failure_of(toy_copter(), Flyer, positions=[(0, 0, -5)])
    assert said.startswith("node 0 (Flyer 0): ")
    assert said.endswith("z = -5 m")


def test_a_parameter_that_the_autopilot_does_not_know_is_refused(toy_copter, quick_answers):
    said = failure_of(toy_copter(), Flyer, autopilot_parameters={"NONESUCH": 1})
    assert said.startswith("node 0 (Flyer 0): ")
    assert " NONESUCH = 1: " in said


@pytest.mark.parametrize(
    ("command", "said"),
    [
        (GotoCoordsMobilityCommand(float("nan"), 0, 0), "finite"),
        (GotoCoordsMobilityCommand(0, 1e8, 0), "100000000.0"),
        (GotoCoordsMobilityCommand(-9e6, 0, 0), "Earth"),
        (GotoGeoCoordsMobilityCommand(91, 0, 0), "latitude 91"),
        (GotoGeoCoordsMobilityCommand(-47.92, -15.84, 10), " -15.84, longitude -47.92?"),
        (SetSpeedMobilityCommand(-1), "speed -1"),
        (SetSpeedMobilityCommand(0.1), "speed 0.1: "),
        (SetVelocityMobilityCommand(1, None, 0), "finite"),
        (MobilityCommand(17), "17"),
    ],
)
def test_a_command_that_means_nothing_is_refused(toy_copter, command, said):
    text = failure_of(toy_copter(), flyer(at_0=command))
    assert text.startswith("node 0")
    assert said in text
