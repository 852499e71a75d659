"""However a simulation ends, nothing is left behind."""

import gc
import os
import signal
import threading

import pytest

from python.simulator.handler.ardupilot_mobility.flying import Flyer, build, fly, flyer


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
