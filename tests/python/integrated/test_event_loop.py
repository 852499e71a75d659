"""What handlers schedule in the engine's event loop."""

import math

import pytest

from gradysim.integrated.run import IntegratedRun, run
from gradysim.simulator.event import EventLoopException
from python.integrated.watching import Scheduling, Watching


def test_events_run_at_their_times(make_scenario):
    times = []
    handler = Scheduling(0.25, lambda: times.append(handler.event_loop.current_time))
    run(make_scenario(), handlers=[handler])
    assert times == [0.25]


def test_an_event_can_schedule_the_next(make_scenario):
    times = []

    def tick():
        times.append(handler.event_loop.current_time)
        handler.event_loop.schedule_event(handler.event_loop.current_time + 0.5, tick)

    handler = Scheduling(0.5, tick)
    run(make_scenario(), handlers=[handler])
    assert times == pytest.approx([0.5, 1.0, 1.5, 2.0])


def test_the_number_of_pending_events(make_scenario):
    handler = Watching()
    IntegratedRun(make_scenario(), handlers=[handler])
    before = len(handler.event_loop)
    handler.event_loop.schedule_event(1, print)
    assert len(handler.event_loop) == before + 1


@pytest.mark.parametrize("time", [-1, math.nan, math.inf, "soon", None])
def test_a_time_that_is_none(make_scenario, time):
    handler = Watching()
    IntegratedRun(make_scenario(), handlers=[handler])
    with pytest.raises(EventLoopException, match="at or after the current time"):
        handler.event_loop.schedule_event(time, print)


def test_a_time_in_the_past(make_scenario):
    handler = Scheduling(1.0, lambda: handler.event_loop.schedule_event(0.5, print))
    with pytest.raises(EventLoopException, match=r"at 0\.5.*current time, 1\.0 s"):
        run(make_scenario(), handlers=[handler])


def test_a_callback_that_cannot_be_called(make_scenario):
    handler = Watching()
    IntegratedRun(make_scenario(), handlers=[handler])
    with pytest.raises(EventLoopException, match="must be callable, got 3"):
        handler.event_loop.schedule_event(1, 3)


def test_what_the_event_loop_has_not_is_said_with_the_mode(make_scenario):
    handler = Watching()
    IntegratedRun(make_scenario(), handlers=[handler])
    with pytest.raises(AttributeError, match=r"no 'pop_event' in integrated mode.*schedule_event"):
        handler.event_loop.pop_event()


def test_what_an_event_raises_ends_the_run(make_scenario):
    def fail():
        raise LookupError("no way out")

    handler = Scheduling(0.5, fail)
    integrated_run = IntegratedRun(make_scenario(), handlers=[handler])
    with pytest.raises(LookupError, match="no way out"):
        integrated_run.execute()
    assert (integrated_run.result().sim_time_s, integrated_run.result().interrupted) == (0.5, True)
    assert handler.ended == 1
