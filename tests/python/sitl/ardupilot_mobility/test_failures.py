"""Failures of autopilots, and their messages."""

import pytest

from gradysim.simulator.handler.ardupilot_mobility import (
    ArdupilotMobilityException,
)
from python.sitl.ardupilot_mobility.flying import Flyer, build, failure_of, fly, flyer
from python.thorough import some


def test_refused_arming_ends_it_with_the_reason_that_was_given(toy_copter):
    program = toy_copter({1: {"refuse_arming": True}})
    said = failure_of(program, Flyer, Flyer, uav_api_startup_timeout=2)
    assert said.startswith("node 1 (Flyer 1): ")
    assert "MAV_RESULT_FAILED" in said
    assert '"PreArm: ' in said


@pytest.mark.parametrize(
    ("wrong", "said"),
    some(
        [
            ({"silent": True}, r"heartbeat: not done after 1 s; the autopilot said: nothing"),
            ({"gives_up": True}, "the autopilot said: nothing; it printed last: invalid param"),
            ({"exits": True}, r"start: the autopilot ended with status 3; it printed last: no such model"),
            ({"no_fix": True}, "position estimate: not done after 1 s; the autopilot said: nothing"),
            ({"deaf": True}, "telemetry: no answer after 5 tries; the autopilot said: nothing"),
        ],
        2,
    ),
)
def test_a_step_that_fails_is_named(toy_copter, wrong, said, quick_answers):
    text = failure_of(toy_copter({0: wrong}), Flyer, uav_api_startup_timeout=1)
    assert text.startswith("node 0 (Flyer 0): ")
    assert said in text


def test_death_in_mid_flight_ends_the_simulation_at_once(toy_copter):
    program = toy_copter({1: {"dies_at": 2}})
    simulator = build(program, Flyer, Flyer, duration=3600)
    with pytest.raises(ArdupilotMobilityException, match=r"^node 1 \(Flyer 1\): .* 7; .*exploded$"):
        simulator.start_simulation()
    assert simulator.current_time < 3600


def test_death_before_the_start_is_noticed_too(toy_copter):
    said = failure_of(toy_copter({0: {"dies_at": "take-off"}}), Flyer)
    assert said.startswith("node 0 (Flyer 0): ")
    assert "status 7" in said


def test_an_autopilot_that_leaves_the_mode_ends_the_simulation(toy_copter):
    said = failure_of(toy_copter({0: {"leaves_at": 2}}), Flyer, duration=3600)
    assert said.startswith("node 0 (Flyer 0): ")
    assert all(part in said for part in (" GUIDED ", " 9; ", '"Battery failsafe"'))


def test_an_autopilot_that_falls_silent_is_given_up(toy_copter, monkeypatch):
    monkeypatch.setattr("gradysim.sitl.ardupilot_mobility.real_time._SILENCE_S", 0.5)
    said = failure_of(toy_copter({0: {"hangs_at": 2}}), Flyer, duration=3600)
    assert said.startswith("node 0 (Flyer 0): ")
    assert "0.5 s" in said


def test_an_exception_of_a_protocol_passes_through(toy_copter):
    def fail(protocol):
        raise ZeroDivisionError("deliberate")

    with pytest.raises(ZeroDivisionError, match="deliberate"):
        fly(toy_copter(), flyer(at_1=fail), Flyer)
