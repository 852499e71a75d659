import math
from decimal import Decimal
from fractions import Fraction
from functools import partial

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

from gradysim.simulator import event
from gradysim.simulator.event import Event, EventLoop, EventLoopException, InstantCount


def run_all(loop):
    while len(loop):
        loop.pop_event().callback()


def nothing():
    pass


def test_a_new_loop_is_empty_at_time_zero():
    loop = EventLoop()
    assert (len(loop), loop.current_time, loop.peek_event(), loop.next_time()) == (0, 0.0, None, None)


@given(st.lists(st.integers(0, 5)))
def test_events_run_by_time_and_then_in_the_order_of_scheduling(times):
    loop = EventLoop()
    ran = []
    for number, time in enumerate(times):
        loop.schedule_event(time, partial(ran.append, (time, number)))
    run_all(loop)
    assert ran == sorted((time, number) for number, time in enumerate(times))


def test_an_event_scheduled_for_now_runs_after_those_scheduled_before():
    loop = EventLoop()
    ran = []

    def first():
        ran.append("first")
        loop.schedule_event(1, partial(ran.append, "third"))

    loop.schedule_event(1, first)
    loop.schedule_event(1, partial(ran.append, "second"))
    run_all(loop)
    assert ran == ["first", "second", "third"]


def test_an_instant_that_is_used_up_can_have_more_events():
    loop = EventLoop()
    loop.schedule_event(1, nothing)
    loop.pop_event()
    assert loop.peek_event() is None
    loop.schedule_event(1, nothing, "more")
    assert (loop.pop_event().context, loop.current_time) == ("more", 1)


@pytest.mark.parametrize("other", [Fraction(1, 3), Decimal(1) / 3])
def test_a_time_that_becomes_the_same_float_is_the_same_instant(other):
    loop = EventLoop()
    ran = []
    for number, time in enumerate((1 / 3, other, 1 / 3)):
        loop.schedule_event(time, partial(ran.append, number))
    run_all(loop)
    assert ran == [0, 1, 2]


@pytest.mark.parametrize("time", [Fraction(1, 3), Decimal(1) / 3])
def test_an_event_is_cancelled_at_the_time_that_it_was_scheduled_for(time):
    loop = EventLoop()
    event = loop.schedule_event(time, nothing)
    assert loop.cancel_event(time, event)
    assert len(loop) == 0


def test_popping_sets_the_clock():
    loop = EventLoop()
    loop.schedule_event(2.5, nothing)
    loop.pop_event()
    assert loop.current_time == 2.5


def test_an_event_has_its_time_callback_and_context():
    loop = EventLoop()
    loop.schedule_event(2, nothing, "context")
    assert loop.pop_event() == Event(2.0, nothing, "context")


def test_events_are_ordered_by_time():
    assert Event(1.0, nothing, "b") < Event(2.0, nothing, "a")


def test_peeking_changes_nothing():
    loop = EventLoop()
    loop.schedule_event(2, nothing, "context")
    assert loop.peek_event() == loop.peek_event() == Event(2.0, nothing, "context")
    assert (loop.current_time, len(loop)) == (0.0, 1)


def test_popping_from_an_empty_loop_is_an_error():
    with pytest.raises(EventLoopException):
        EventLoop().pop_event()


@pytest.mark.parametrize(
    "timestamp", [0.9, -1, math.nan, math.inf, pytest.param(10**400, id="huge"), "2", None, [2]]
)
def test_a_time_that_cannot_be_is_refused(timestamp):
    loop = EventLoop()
    loop.schedule_event(1, nothing)
    loop.pop_event()
    with pytest.raises(EventLoopException, match=r"1\.0 s"):
        loop.schedule_event(timestamp, nothing)
    assert len(loop) == 0


def test_a_callback_must_be_callable():
    with pytest.raises(EventLoopException):
        EventLoop().schedule_event(1, "text")


def test_scheduling_several_keeps_their_order():
    loop = EventLoop()
    ran = []
    loop.schedule_event(1, partial(ran.append, 0))
    loop.schedule_events(1, [(partial(ran.append, number), "") for number in (1, 2)])
    loop.schedule_event(1, partial(ran.append, 3))
    assert len(loop) == 4
    run_all(loop)
    assert ran == [0, 1, 2, 3]


def test_scheduling_several_in_the_past_is_refused():
    with pytest.raises(EventLoopException):
        EventLoop().schedule_events(-1, [(nothing, "")])


def test_a_cancelled_event_is_gone():
    loop = EventLoop()
    event = loop.schedule_event(1, nothing)
    assert loop.cancel_event(1, event) is True
    assert (len(loop), loop.peek_event(), loop.next_time()) == (0, None, None)


def test_cancelling_twice_does_nothing():
    loop = EventLoop()
    event = loop.schedule_event(1, nothing)
    loop.cancel_event(1, event)
    assert loop.cancel_event(1, event) is False


def test_cancelling_an_event_that_ran_does_nothing():
    loop = EventLoop()
    event = loop.schedule_event(1, nothing, "a")
    loop.schedule_event(1, nothing, "b")
    loop.pop_event()
    assert loop.cancel_event(1, event) is False
    assert loop.pop_event().context == "b"


def test_an_event_can_be_cancelled_by_one_of_its_own_instant():
    loop = EventLoop()
    ran = []
    loop.schedule_event(1, lambda: loop.cancel_event(1, victim))
    victim = loop.schedule_event(1, partial(ran.append, "victim"))
    loop.schedule_event(1, partial(ran.append, "other"))
    run_all(loop)
    assert ran == ["other"]


def test_a_cancelled_instant_can_be_used_again():
    loop = EventLoop()
    loop.cancel_event(1, loop.schedule_event(1, nothing, "old"))
    loop.schedule_event(1, nothing, "new")
    assert [loop.pop_event().context, len(loop)] == ["new", 0]


def test_taking_stops_before_the_first_event_after_the_limit():
    loop = EventLoop()
    for time in (1, 2, 3):
        loop.schedule_event(time, nothing, str(time))
    assert [context for _, context in loop.take_events(until=2)] == ["1", "2"]
    assert (loop.current_time, loop.next_time()) == (2, 3)


def test_taking_one_stops_before_the_first_event_after_the_limit():
    loop = EventLoop()
    for time in (1, 3):
        loop.schedule_event(time, nothing, str(time))
    assert loop.take_event(until=1) == (nothing, "1")
    assert loop.take_event(until=2) is None
    assert (loop.current_time, loop.take_event(), loop.take_event()) == (1, (nothing, "3"), None)


def test_one_and_several_can_be_taken_in_turns():
    loop = EventLoop()
    for number in range(4):
        loop.schedule_event(number // 3, nothing, str(number))
    events = loop.take_events()
    taken = [next(events), loop.take_event(), next(events), loop.take_event()]
    assert [context for _, context in taken] == ["0", "1", "2", "3"]
    assert next(events, None) is None


def test_taking_sees_what_is_scheduled_meanwhile():
    loop = EventLoop()
    loop.schedule_event(1, nothing, "first")
    events = loop.take_events()
    next(events)
    loop.schedule_event(1, nothing, "now")
    loop.schedule_event(5, nothing, "later")
    assert [context for _, context in events] == ["now", "later"]


def test_clearing_forgets_events_and_keeps_the_time():
    loop = EventLoop()
    for time in (1, 1, 2):
        loop.schedule_event(time, nothing)
    loop.pop_event()
    loop.clear()
    assert (len(loop), loop.peek_event(), loop.current_time) == (0, None, 1)


def test_a_long_instant_does_not_keep_the_events_that_ran():
    loop = EventLoop()
    remaining = 200_000

    def again():
        nonlocal remaining
        remaining -= 1
        if remaining:
            loop.schedule_event(0, again)

    loop.schedule_event(0, again)
    run_all(loop)
    assert (remaining, len(loop)) == (0, 0)


@pytest.mark.parametrize("taken_at_once", [False, True])
def test_all_events_of_a_long_instant_run_in_their_order(taken_at_once):
    loop = EventLoop()
    count = 200_000
    loop.schedule_events(0, [(nothing, str(number)) for number in range(count)])
    events = loop.take_events() if taken_at_once else iter(loop.take_event, None)
    assert [context for _, context in events] == [str(number) for number in range(count)]
    assert len(loop) == 0


def test_the_clock_can_be_set_forward_to_a_time_without_events():
    loop = EventLoop()
    loop.schedule_event(5, nothing)
    loop.advance_to(4)
    assert (loop.current_time, loop.next_time()) == (4, 5)


@pytest.mark.parametrize("timestamp", [0.5, 5.5, math.inf, math.nan])
def test_the_clock_cannot_be_set_back_nor_past_an_event(timestamp):
    loop = EventLoop()
    loop.schedule_event(1, nothing)
    loop.pop_event()
    loop.schedule_event(5, nothing)
    with pytest.raises(EventLoopException):
        loop.advance_to(timestamp)


def test_the_clock_cannot_be_set_to_the_end_of_all_times():
    with pytest.raises(EventLoopException, match="inf"):
        EventLoop().advance_to(math.inf)


class AgainstASortedList(RuleBasedStateMachine):
    """For all sequences of operations, a loop behaves like a list sorted by (time, order of scheduling)."""

    def __init__(self):
        super().__init__()
        self.loop = EventLoop()
        self.expected = []
        self.scheduled = []
        self.number = 0

    @rule(delay=st.integers(0, 3))
    def schedule(self, delay):
        time = self.loop.current_time + delay
        event = self.loop.schedule_event(time, nothing, str(self.number))
        self.expected.append((time, self.number))
        self.scheduled.append((time, self.number, event))
        self.number += 1

    @rule(delay=st.integers(0, 3), count=st.integers(0, 3))
    def schedule_several(self, delay, count):
        time = self.loop.current_time + delay
        numbers = range(self.number, self.number + count)
        self.loop.schedule_events(time, [(nothing, str(number)) for number in numbers])
        self.expected.extend((time, number) for number in numbers)
        self.number += count

    @precondition(lambda self: self.scheduled)
    @rule(data=st.data())
    def cancel(self, data):
        time, number, event = data.draw(st.sampled_from(self.scheduled))
        pending = (time, number) in self.expected
        assert self.loop.cancel_event(time, event) is pending
        if pending:
            self.expected.remove((time, number))

    @precondition(lambda self: self.expected)
    @rule()
    def pop(self):
        event = self.loop.pop_event()
        assert (event.timestamp, int(event.context)) == min(self.expected)
        self.expected.remove(min(self.expected))
        assert self.loop.current_time == event.timestamp

    @rule()
    def clear(self):
        self.loop.clear()
        self.expected.clear()

    @invariant()
    def has_as_many_events(self):
        assert len(self.loop) == len(self.expected)

    @invariant()
    def sees_the_next_one(self):
        event = self.loop.peek_event()
        seen = None if event is None else (event.timestamp, int(event.context))
        assert seen == min(self.expected, default=None)


TestAgainstASortedList = AgainstASortedList.TestCase
TestAgainstASortedList.settings = settings(max_examples=60, stateful_step_count=30)


@pytest.fixture
def count(monkeypatch):
    monkeypatch.setattr(event, "MOST_AT_ONE_INSTANT", 3)
    return InstantCount()


def test_it_exceeds_the_bound_with_the_next_one(count):
    assert [count.exceeds(2.5) for _ in range(5)] == [False, False, False, True, True]


def test_it_begins_anew_at_each_instant(count):
    assert not any(count.exceeds(instant) for instant in (0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0))
