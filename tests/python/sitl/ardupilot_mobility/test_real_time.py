"""Autopilots in real time; all resources are freed for all kinds of ends."""

import asyncio
import gc
import logging
import os
import signal
import threading

import pytest

from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.ardupilot_mobility import ArdupilotMobilityConfiguration
from gradysim.sitl.ardupilot_mobility.real_time import FreeRunning
from python.sitl.ardupilot_mobility.flying import Flyer, build, failure_of, fly, flyer


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


def test_one_that_cannot_start_ends_the_others(toy_copter, caplog):
    said = failure_of(toy_copter({0: {"silent": True}, 1: {"exits": True}}), Flyer, Flyer)
    assert said.startswith("node 1 (Flyer 1): ")
    assert "status 3" in said
    gc.collect()
    assert [record.message for record in caplog.records if record.levelno > logging.INFO] == []


@pytest.mark.parametrize(("simulate_drones", "levels"), [(False, [logging.WARNING]), (True, [])])
def test_who_flies_real_vehicles_is_told_that_they_are_in_the_air(simulate_drones, levels, caplog):
    configuration = ArdupilotMobilityConfiguration(
        simulate_drones=simulate_drones, vehicle_addresses=None if simulate_drones else {}
    )
    loop = asyncio.new_event_loop()
    flying = FreeRunning({}, configuration, EventLoop(), loop, real_time=1.0)
    flying.begin()
    flying.end()
    flying.close()
    loop.run_until_complete(asyncio.sleep(0))
    loop.close()
    assert [record.levelno for record in caplog.records] == levels
