import math
from itertools import repeat

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gradysim.simulator import event
from gradysim.simulator.event import _RAN_AT_MOST, EventLoop
from gradysim.simulator.handler.timer import TimerException, TimerHandler
from gradysim.simulator.node import Node


@pytest.fixture
def handler(world):
    handler = TimerHandler()
    handler.inject(world.loop)
    return handler


@pytest.fixture
def node(world, handler):
    return world.node(0, handler=handler)


def test_the_label():
    assert TimerHandler.get_label() == "timer"


def test_a_timer_fires_at_its_time(world, handler, node):
    handler.set_timer("a", 2.5, node)
    world.run()
    assert node.protocol_encapsulator.calls == [(2.5, "a")]


def test_several_timers_of_one_name_all_fire(world, handler, node):
    for time in (2, 1, 1):
        handler.set_timer("a", time, node)
    world.run()
    assert node.protocol_encapsulator.calls == [(1, "a"), (1, "a"), (2, "a")]


def test_nothing_is_kept_of_a_timer_that_fired(world, handler, node):
    for time in (1, 2):
        handler.set_timer(f"a name of its own {time}", time, node)
    world.run()
    assert handler._pending == {node.id: {}}


def test_a_timer_for_now_fires(world, handler, node):
    handler.set_timer("a", 0, node)
    world.run()
    assert node.protocol_encapsulator.calls == [(0, "a")]


def test_cancelling_removes_every_timer_of_the_name(world, handler, node):
    handler.set_timer("a", 1, node)
    handler.set_timer("a", 2, node)
    handler.set_timer("b", 3, node)
    handler.cancel_timer("a", node)
    world.run()
    assert node.protocol_encapsulator.calls == [(3, "b")]


def test_a_cancelled_timer_leaves_no_event(world, handler, node):
    handler.set_timer("a", 1, node)
    handler.cancel_timer("a", node)
    assert len(world.loop) == 0


def test_cancelling_leaves_the_timers_of_others(world, handler, node):
    other = world.node(1, handler=handler)
    handler.set_timer("a", 1, node)
    handler.set_timer("a", 1, other)
    handler.cancel_timer("a", node)
    world.run()
    assert other.protocol_encapsulator.calls == [(1, "a")]


def test_cancelling_what_is_not_pending_does_nothing(world, handler, node):
    handler.cancel_timer("a", node)
    assert len(world.loop) == 0


def test_a_timer_can_be_set_again_after_cancelling(world, handler, node):
    handler.set_timer("a", 1, node)
    handler.cancel_timer("a", node)
    handler.set_timer("a", 2, node)
    world.run()
    assert node.protocol_encapsulator.calls == [(2, "a")]


def test_a_callback_can_cancel_its_own_name(world, handler, node):
    fired = []

    def handle_timer(timer):
        fired.append(world.loop.current_time)
        handler.cancel_timer(timer, node)

    node.protocol_encapsulator.handle_timer = handle_timer
    for time in (1, 1, 2):
        handler.set_timer("a", time, node)
    world.run()
    assert fired == [1]


def test_a_callback_can_set_its_own_name_again(world, handler, node):
    fired = []

    def handle_timer(timer):
        fired.append(world.loop.current_time)
        if len(fired) < 3:
            handler.set_timer(timer, world.loop.current_time + 1, node)

    node.protocol_encapsulator.handle_timer = handle_timer
    handler.set_timer("a", 1, node)
    world.run()
    assert fired == [1, 2, 3]


@pytest.mark.parametrize(
    "timestamp", [0.5, -1, math.nan, math.inf, pytest.param(10**400, id="huge"), "2", None, [2]]
)
def test_a_time_that_cannot_be_is_refused(world, handler, node, timestamp):
    handler.set_timer("first", 1, node)
    world.run()
    with pytest.raises(TimerException, match=r"'a' .*node 0.* 1\.0 s"):
        handler.set_timer("a", timestamp, node)


def test_a_refused_timer_is_not_pending(world, handler, node):
    with pytest.raises(TimerException):
        handler.set_timer("a", -1, node)
    handler.cancel_timer("a", node)
    assert len(world.loop) == 0


def test_a_name_that_is_no_text_is_refused(handler, node):
    with pytest.raises(TimerException, match="5"):
        handler.set_timer(5, 1, node)


def test_a_name_that_is_no_text_cannot_be_cancelled(handler, node):
    with pytest.raises(TimerException, match="5"):
        handler.cancel_timer(5, node)


def test_a_stranger_is_refused(world, handler):
    stranger = world.node(7)
    with pytest.raises(TimerException, match="node 7"):
        handler.set_timer("a", 1, stranger)
    with pytest.raises(TimerException, match="node 7"):
        handler.cancel_timer("a", stranger)


def test_without_an_event_loop_no_timer_can_be_set(world):
    handler = TimerHandler()
    node = world.node(0, handler=handler)
    with pytest.raises(TimerException):
        handler.set_timer("a", 1, node)


def test_the_time_is_the_loops(world, handler, node):
    handler.set_timer("a", 2.5, node)
    world.run()
    assert handler.get_current_time() == 2.5


def test_a_new_event_loop_forgets_the_nodes(handler, node):
    handler.inject(EventLoop())
    with pytest.raises(TimerException):
        handler.set_timer("a", 1, node)


operations = st.lists(st.tuples(st.sampled_from(["set", "cancel"]), st.sampled_from("ab"), st.integers(0, 4)))


@settings(max_examples=60)
@given(operations)
def test_what_fires_is_what_was_set_and_not_cancelled_in_order(steps):
    loop = EventLoop()
    handler = TimerHandler()
    handler.inject(loop)
    fired = []

    class Encapsulator:
        def handle_timer(self, timer):
            fired.append((loop.current_time, timer))

    node = Node()
    node.id, node.position, node.protocol_encapsulator = 0, (0, 0, 0), Encapsulator()
    handler.register_node(node)
    expected = []
    for operation, name, time in steps:
        if operation == "set":
            handler.set_timer(name, time, node)
            expected.append((time, name))
        else:
            handler.cancel_timer(name, node)
            expected = [timer for timer in expected if timer[1] != name]
    assert len(loop) == len(expected)
    while len(loop):
        loop.pop_event().callback()
    assert fired == sorted(expected, key=lambda timer: timer[0])


class TestStandingTime:
    """A node that sets timers for now without end."""

    @pytest.fixture
    def again(self, monkeypatch, world, handler, node):
        """Make each timer set another one, `delay` seconds later."""
        monkeypatch.setattr(event, "MOST_AT_ONE_INSTANT", 10)

        def again(delay, times=None):
            left = iter(range(times)) if times else repeat(0)

            def set_another(timer):
                if next(left, None) is not None:
                    handler.set_timer(timer, world.loop.current_time + delay, node)

            node.protocol_encapsulator.handle_timer = set_another
            handler.set_timer("tick", 2.5, node)

        return again

    def test_it_is_told_which_node_and_timer(self, world, again):
        again(delay=0.0)
        with pytest.raises(TimerException, match=r"node 0 .* 2\.5 s, .*'tick'"):
            world.run()

    def test_time_that_goes_on_is_fine(self, world, again):
        again(delay=1e-9, times=_RAN_AT_MOST + 20)
        world.run()
        assert world.loop.current_time == pytest.approx(2.5 + 1e-9 * (_RAN_AT_MOST + 20))

    def test_some_more_timers_for_now_are_fine_when_the_instant_is_crowded(self, world, again):
        again(delay=0.0, times=_RAN_AT_MOST + 5)
        world.run()
        assert len(world.loop) == 0

    def test_many_timers_for_now_are_fine_before_the_instant_is_crowded(self, world, again):
        again(delay=0.0, times=_RAN_AT_MOST - 1)
        world.run()
        assert len(world.loop) == 0
