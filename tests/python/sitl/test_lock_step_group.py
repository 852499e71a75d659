"""Autopilots in lock-step that fly at the same time."""

import time
from contextlib import ExitStack, closing

import pytest

from gradysim.sitl.error import SitlError
from gradysim.sitl.flights import Flights
from gradysim.sitl.lock_step_group import LockStepGroup
from python.sitl.on_simulated_time import REFERENCE, failure_of, flown, nodes
from python.sitl.played_autopilot import Played

pytestmark = pytest.mark.usefixtures("own_folder")


@pytest.fixture
def group_of():
    """`group_of(played, ...)`: a group of these."""
    with ExitStack() as ends:

        def make(*played):
            group = LockStepGroup([ends.enter_context(closing(each)).ours for each in played])
            ends.callback(group.close)
            return group

        yield make


def test_each_takes_its_own_steps_to_the_same_time(group_of):
    coarse, fine = Played(rate_hz=400), Played(rate_hz=1200)
    group = group_of(coarse, fine)
    for frame in range(2, 4):
        coarse.wish(frame, 400)
    for frame in range(2, 8):
        fine.wish(frame, 1200)
    group.fly_to(0.005)
    assert [coarse.felt()["timestamp"] for _ in range(2)] == [1 / 400, 2 / 400]
    assert [fine.felt()["timestamp"] for _ in range(6)] == [number / 1200 for number in range(1, 7)]


def test_what_they_said_is_told_in_their_order_whoever_is_fastest(group_of):
    slow, fast = Played("slow"), Played("fast")
    group = group_of(slow, fast)
    heard = []
    for played in (fast, slow):
        link = played.ours.link
        link.on_bytes = lambda data, name=link.name: heard.append(name)
        played.mavlink.sendall(b"\0")
        played.wish(2)
    assert group.fly_to(0.0025)
    assert heard == ["slow", "fast"]


def test_it_tells_when_nobody_said_anything(group_of):
    played = Played()
    group = group_of(played)
    played.wish(2)
    assert not group.fly_to(0.0025)


def test_a_simulation_that_takes_its_time_changes_nothing(toy_copter, flights_of):
    """Meanwhile the autopilot asks again and again for its next step."""

    def flight(wrongs, pause_s):
        flights = flights_of(toy_copter(wrongs), (0.0, 0.0, 10.0))
        flights.pilot(0).go_to((40.0, 10.0, 15.0))
        track = flown(flights, 0.5)
        time.sleep(pause_s)
        return [*track, *flown(flights, 1, begin=0.5)]

    assert flight({0: {"repeats": True}}, 0.4) == flight({}, 0.0)


def test_an_autopilot_that_hangs_is_given_up(toy_copter, flights_of, monkeypatch):
    monkeypatch.setattr("gradysim.sitl.lock_step_group._SILENCE_S", 0.5)
    said = failure_of(flights_of, toy_copter({0: {"hangs_at": 2}}))
    assert said.startswith("vehicle 0: no sign of life in 0.5 s of wall time")


def test_so_is_one_that_hangs_beside_another_that_waits_for_it(toy_copter, monkeypatch):
    monkeypatch.setattr("gradysim.sitl.lock_step_group._SILENCE_S", 0.5)
    program = toy_copter({0: {"repeats": True}, 1: {"hangs_at": 2}})
    flights = Flights(nodes(program, (0.0, 0.0, 10.0), (0.0, 9.0, 10.0)), REFERENCE)
    with pytest.raises(SitlError, match="vehicle 1: no sign of life in"):
        flights.begin()
    flights.close()


def _interrupt(timeout_s):
    raise KeyboardInterrupt


def test_a_step_that_was_interrupted_goes_on_where_it_was(toy_copter, flights_of, monkeypatch):
    """By Ctrl-C while autopilots are at work: none of them is answered twice."""

    def flight(*, interrupted):
        flights = flights_of(toy_copter(), (0.0, 0.0, 10.0), (0.0, 20.0, 10.0))
        flights.pilot(0).go_to((40.0, 10.0, 15.0))
        track = flown(flights, 1)
        if interrupted:
            with monkeypatch.context() as patch:
                patch.setattr(flights._group._selector, "select", _interrupt)
                with pytest.raises(KeyboardInterrupt):
                    flights.advance_to(1.01)
        return [*track, *flown(flights, 1, begin=1.0)]

    assert flight(interrupted=True) == flight(interrupted=False)
