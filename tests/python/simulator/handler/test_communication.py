import math
from functools import partial
from itertools import repeat
from random import Random
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.messages.communication import (
    BroadcastMessageCommand,
    CommunicationCommand,
    CommunicationCommandType,
    SendMessageCommand,
)
from gradysim.simulator import event
from gradysim.simulator.event import _RAN_AT_MOST, EventLoop
from gradysim.simulator.handler.communication import (
    CommunicationException,
    CommunicationHandler,
    CommunicationMedium,
    can_transmit,
)


@pytest.fixture
def network(world):
    """Make a handler with nodes 0, 1, ... at the given x."""

    def make(medium=None, xs=(0, 50, 70)):
        handler = CommunicationHandler(medium) if medium else CommunicationHandler()
        handler.inject(world.loop)
        return handler, [world.node(number, (x, 0, 0), handler) for number, x in enumerate(xs)]

    return make


def received(nodes):
    return [node.protocol_encapsulator.calls for node in nodes]


def test_the_label():
    assert CommunicationHandler.get_label() == "communication"


def test_the_default_medium_is_the_published_one():
    expected = CommunicationMedium(transmission_range=60, delay=0, failure_rate=0)
    assert CommunicationHandler().default_medium == CommunicationMedium() == expected


def test_a_broadcast_reaches_all_others_in_range(world, network):
    handler, nodes = network()
    handler.handle_command(BroadcastMessageCommand("hi"), nodes[0])
    world.run()
    assert received(nodes) == [[], [(0, "hi")], []]


@pytest.mark.parametrize("interface", [1, 15])
def test_all_interfaces_share_the_one_medium(world, network, interface):
    handler, nodes = network()
    handler.handle_command(BroadcastMessageCommand("hi", interface=interface), nodes[0])
    world.run()
    assert received(nodes) == [[], [(0, "hi")], []]


def test_a_broadcast_of_ones_own_needs_no_interface_and_no_destination(world, network):
    handler, nodes = network()
    kind = CommunicationCommandType.BROADCAST
    handler.handle_command(SimpleNamespace(command_type=kind, message="hi"), nodes[0])
    world.run()
    assert received(nodes) == [[], [(0, "hi")], []]


def test_a_message_to_one_reaches_that_one(world, network):
    handler, nodes = network()
    handler.handle_command(SendMessageCommand("hi", 2), nodes[1])
    world.run()
    assert received(nodes) == [[], [], [(0, "hi")]]


def test_a_message_to_one_out_of_range_is_lost(world, network):
    handler, nodes = network()
    handler.handle_command(SendMessageCommand("hi", 2), nodes[0])
    assert world.run() == 0


def test_the_range_is_inclusive(world, network):
    handler, nodes = network(CommunicationMedium(transmission_range=50))
    handler.handle_command(BroadcastMessageCommand("hi"), nodes[0])
    world.run()
    assert received(nodes) == [[], [(0, "hi")], []]


def test_the_delay_is_that_of_the_medium(world, network):
    handler, nodes = network(CommunicationMedium(delay=1.5))
    handler.handle_command(BroadcastMessageCommand("hi"), nodes[0])
    world.run()
    assert received(nodes)[1] == [(1.5, "hi")]


def test_who_is_in_range_is_decided_at_the_instant_of_sending(world, network):
    handler, nodes = network(CommunicationMedium(delay=1))
    handler.handle_command(BroadcastMessageCommand("hi"), nodes[0])
    nodes[1].position = (1000, 0, 0)
    nodes[2].position = (0, 0, 0)
    world.run()
    assert received(nodes) == [[], [(1, "hi")], []]


def test_a_command_can_have_a_medium_of_its_own(world, network):
    handler, nodes = network()
    handler.handle_command(BroadcastMessageCommand("hi"), nodes[0], CommunicationMedium(1000))
    world.run()
    assert received(nodes) == [[], [(0, "hi")], [(0, "hi")]]


class Farther(CommunicationHandler):
    """A user's handler: the range depends on both ends. It is 100 m to node 2, and 0 m to node 1."""

    asked = ()

    def _transmit_message(self, message, source, destination, medium):
        self.asked += ((source.node.id, destination.node.id, medium),)
        source.hand_over_message(message, destination)
        if destination.node.id == 2:
            medium = CommunicationMedium(transmission_range=100, delay=0.5)
        if destination.node.id != 1:
            super()._transmit_message(message, source, destination, medium)


def test_a_handler_of_ones_own_decides_copy_by_copy(world):
    handler = Farther()
    handler.inject(world.loop)
    nodes = [world.node(number, (x, 0, 0), handler) for number, x in enumerate((0, 50, 70, 60, 90))]
    handler.handle_command(BroadcastMessageCommand("to all"), nodes[0])
    handler.handle_command(SendMessageCommand("to one", 2), nodes[3])
    world.run()
    assert received(nodes) == [[], [], [(0.5, "to all"), (0.5, "to one")], [(0, "to all")], []]
    medium = handler.default_medium
    assert handler.asked == (*((0, other, medium) for other in (1, 2, 3, 4)), (3, 2, medium))


def test_a_handler_of_ones_own_is_told_of_the_medium_of_a_command(world):
    handler = Farther()
    handler.inject(world.loop)
    nodes = [world.node(number, (0, 0, 0), handler) for number in range(2)]
    own = CommunicationMedium(transmission_range=1)
    handler.handle_command(BroadcastMessageCommand("hi"), nodes[0], own)
    assert handler.asked == ((0, 1, own),)


def test_messages_of_one_instant_arrive_in_the_order_of_sending(world, network):
    handler, nodes = network(xs=(0, 0, 0))
    for text in "abc":
        handler.handle_command(BroadcastMessageCommand(text), nodes[0])
    world.run()
    assert [message for _, message in received(nodes)[1]] == ["a", "b", "c"]


def test_a_failure_rate_of_one_loses_everything(world, network):
    handler, nodes = network(CommunicationMedium(failure_rate=1))
    for _ in range(50):
        handler.handle_command(BroadcastMessageCommand("hi"), nodes[0])
    assert world.run() == 0


def test_the_failure_rate_is_the_share_of_lost_messages(world, network):
    handler, nodes = network(CommunicationMedium(failure_rate=0.3))
    for _ in range(5000):
        handler.handle_command(SendMessageCommand("hi", 1), nodes[0])
    # Four standard deviations of a binomial with n = 5000, p = 0.7.
    assert world.run() / 5000 == pytest.approx(0.7, abs=4 * math.sqrt(0.7 * 0.3 / 5000))


def test_the_losses_follow_from_the_seed(world):
    def losses(seed):
        handler = CommunicationHandler(CommunicationMedium(failure_rate=0.5))
        handler.inject(EventLoop())
        nodes = [world.node(number) for number in range(2)]
        for node in nodes:
            node.seed = seed
            handler.register_node(node)
        pending = []
        for _ in range(64):
            handler.handle_command(SendMessageCommand("hi", 1), nodes[0])
            pending.append(len(handler._event_loop))
        return pending

    assert losses(1) == losses(1) != losses(2)


def test_another_node_does_not_change_the_losses_of_the_first_ones(world):
    def heard(count):
        handler = CommunicationHandler(CommunicationMedium(failure_rate=0.5))
        loop = EventLoop()
        handler.inject(loop)
        nodes = [world.node(number, handler=handler) for number in range(count)]
        for number in range(64):
            handler.handle_command(BroadcastMessageCommand(str(number)), nodes[0])
        while len(loop):
            loop.pop_event().callback()
        return [message for _, message in nodes[1].protocol_encapsulator.calls]

    assert heard(2) == heard(5)


@pytest.mark.parametrize(
    "command",
    [
        SendMessageCommand("hi", 0),
        SendMessageCommand("hi", 9),
        SendMessageCommand("hi", "1"),
        SendMessageCommand("hi", [1]),
        SendMessageCommand("hi", None),
        SendMessageCommand("hi", 1, interface=16),
        SendMessageCommand("hi", 1, interface=None),
        CommunicationCommand(CommunicationCommandType.SEND, "hi"),
        CommunicationCommand(7, "hi"),
        BroadcastMessageCommand(b"hi"),
        BroadcastMessageCommand({"a": 1}),
        "hi",
    ],
)
def test_an_invalid_command_is_refused(network, command):
    handler, nodes = network()
    with pytest.raises(CommunicationException):
        handler.handle_command(command, nodes[0])


def test_a_stranger_is_refused(world, network):
    handler, _ = network()
    with pytest.raises(CommunicationException, match="node 7"):
        handler.handle_command(BroadcastMessageCommand("hi"), world.node(7))


def test_nodes_come_after_the_event_loop(world):
    with pytest.raises(CommunicationException):
        world.node(0, handler=CommunicationHandler())


@pytest.mark.parametrize(
    "wrong",
    [
        {"transmission_range": -1},
        {"transmission_range": math.nan},
        {"delay": -0.1},
        {"delay": math.inf},
        {"failure_rate": -0.1},
        {"failure_rate": 1.1},
        {"failure_rate": math.nan},
        {"transmission_range": "far"},
        {"delay": None},
    ],
)
def test_a_wrong_medium_is_refused(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        CommunicationMedium(**wrong)


def test_an_unlimited_range_is_possible():
    assert CommunicationMedium(transmission_range=math.inf).transmission_range == math.inf


def test_what_is_no_medium_is_refused():
    with pytest.raises(TypeError, match="CommunicationMedium"):
        CommunicationHandler(60)


coordinates = st.floats(-100, 100)
positions = st.tuples(coordinates, coordinates, coordinates)


@given(source=positions, destination=positions, reach=st.floats(0, 200))
def test_the_handler_delivers_what_can_be_transmitted(new_world, source, destination, reach):
    world = new_world()
    medium = CommunicationMedium(transmission_range=reach)
    handler = CommunicationHandler(medium)
    handler.inject(world.loop)
    sender = world.node(0, source, handler)
    world.node(1, destination, handler)
    handler.handle_command(BroadcastMessageCommand("hi"), sender)
    assert (world.run() == 1) == can_transmit(source, destination, medium)


def test_transmission_draws_only_if_it_can_fail():
    stream = Random(1)
    before = stream.getstate()
    can_transmit((0, 0, 0), (1, 0, 0), CommunicationMedium(), stream)
    can_transmit((0, 0, 0), (100, 0, 0), CommunicationMedium(failure_rate=0.5), stream)
    assert stream.getstate() == before


@pytest.mark.parametrize(("rate", "expected"), [(1.0, False), (0.0, True)])
def test_certain_failure_and_certain_success(rate, expected):
    assert can_transmit((0, 0, 0), (1, 0, 0), CommunicationMedium(failure_rate=rate)) is expected


class TestStandingTime:
    """Messages that answer each other."""

    @pytest.fixture
    def answering(self, monkeypatch, network):
        """Return two nodes that answer each message, over a medium with that delay."""
        monkeypatch.setattr(event, "MOST_AT_ONE_INSTANT", 10)

        def answering(delay, times=None):
            handler, nodes = network(CommunicationMedium(delay=delay), xs=(0, 10))
            left = iter(range(times)) if times else repeat(0)

            def answer(node, message):
                if next(left, None) is not None:
                    handler.handle_command(SendMessageCommand(message, 1 - node.id), node)

            for node in nodes:
                node.protocol_encapsulator.handle_packet = partial(answer, node)
            handler.handle_command(SendMessageCommand("ping", 1), nodes[0])

        return answering

    def test_it_is_told_which_node_and_what_to_do(self, world, answering):
        answering(delay=0.0)
        expected = r"^node [01] has sent .* at 0\.0 s, with a delay of 0\.0 s: time stands still"
        with pytest.raises(CommunicationException, match=expected):
            world.run()

    def test_time_that_goes_on_is_fine(self, world, answering):
        answering(delay=1e-9, times=_RAN_AT_MOST + 40)
        world.run()
        assert world.loop.current_time == pytest.approx(1e-9 * (_RAN_AT_MOST + 41))

    def test_some_more_messages_are_fine_when_the_instant_is_crowded(self, world, answering):
        answering(delay=0.0, times=_RAN_AT_MOST + 5)
        world.run()
        assert len(world.loop) == 0

    def test_many_messages_at_once_are_fine_before_the_instant_is_crowded(self, world, answering):
        answering(delay=0.0, times=_RAN_AT_MOST - 1)
        world.run()
        assert len(world.loop) == 0
