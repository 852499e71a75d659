import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.communication import (
    CommunicationException,
    CommunicationHandler,
    CommunicationMedium,
    DeliveryLedger,
)
from gradysim.simulator.node import Node


class Receiver:
    def __init__(self):
        self.received = []

    def handle_packet(self, message):
        self.received.append(message)


class World:
    """Nodes on a line, their network and its ledger."""

    def __init__(self, positions_m, medium, seed=0):
        self.loop = EventLoop()
        self.ledger = DeliveryLedger()
        self.network = CommunicationHandler(medium, self.ledger)
        self.network.inject(self.loop)
        self.nodes = []
        for identifier, x in enumerate(positions_m):
            node = Node()
            node.id, node.position, node.seed = identifier, (x, 0.0, 0.0), seed
            node.protocol_encapsulator = Receiver()
            self.network.register_node(node)
            self.nodes.append(node)

    def run(self, until_s=float("inf")):
        while (event := self.loop.peek_event()) is not None and event.timestamp <= until_s:
            self.loop.pop_event().callback()

    def received(self):
        return sum(len(node.protocol_encapsulator.received) for node in self.nodes)


def test_copies_of_a_broadcast():
    world = World([0, 10, 60, 61], CommunicationMedium(transmission_range=60))
    world.network.handle_command(BroadcastMessageCommand("a"), world.nodes[0])
    world.run()
    assert world.ledger.frame_outcomes()["broadcast"] == {
        "delivered": 2,
        "below_sensitivity": 1,
        "lost": 0,
        "in_air": 0,
    }


@pytest.mark.parametrize(("destination", "outcome"), [(1, "delivered"), (2, "below_sensitivity")])
def test_the_copy_of_a_message_to_one_node(destination, outcome):
    world = World([0, 10, 100], CommunicationMedium())
    world.network.handle_command(SendMessageCommand("a", destination), world.nodes[0])
    world.run()
    outcomes = world.ledger.frame_outcomes()["unicast"]
    assert {name: count for name, count in outcomes.items() if count} == {outcome: 1}


def test_lost_copies_are_told_from_those_out_of_range():
    world = World([0, 10, 100], CommunicationMedium(failure_rate=1))
    world.network.handle_command(BroadcastMessageCommand("a"), world.nodes[0])
    assert world.ledger.frame_outcomes()["broadcast"] == {
        "delivered": 0,
        "below_sensitivity": 1,
        "lost": 1,
        "in_air": 0,
    }


@pytest.mark.parametrize("delay_s", [0, 1])
def test_a_copy_is_in_the_air_until_it_arrives(delay_s):
    world = World([0, 10], CommunicationMedium(delay=delay_s))
    world.network.handle_command(BroadcastMessageCommand("a"), world.nodes[0])
    assert world.ledger.frame_outcomes()["broadcast"]["in_air"] == 1
    world.run()
    assert world.ledger.frame_outcomes()["broadcast"]["in_air"] == 0


def test_delays_are_of_those_that_arrived():
    world = World([0, 10, 20], CommunicationMedium(delay=1))
    world.network.handle_command(BroadcastMessageCommand("a"), world.nodes[0])
    quick = CommunicationMedium(delay=0.5)
    world.network.handle_command(SendMessageCommand("b", 1), world.nodes[0], quick)
    assert world.ledger.delays() == {"broadcast": {1: 0}, "unicast": {0.5: 0}}
    world.run()
    assert world.ledger.delays() == {"broadcast": {1: 2}, "unicast": {0.5: 1}}


def test_a_medium_of_its_own():
    world = World([0, 10], CommunicationMedium())
    short = CommunicationMedium(transmission_range=5)
    world.network.handle_command(BroadcastMessageCommand("a"), world.nodes[0], short)
    assert world.ledger.frame_outcomes()["broadcast"]["below_sensitivity"] == 1


def test_messages_are_counted_once():
    world = World([0, 10, 20], CommunicationMedium())
    world.network.handle_command(BroadcastMessageCommand("a"), world.nodes[0])
    world.network.handle_command(SendMessageCommand("b", 2), world.nodes[0])
    outcomes = world.ledger.message_outcomes()
    assert outcomes["broadcast"] == {"sent": 1}
    assert outcomes["unicast"] == {"acknowledged": 0, "out_of_range": 0, "lost": 0, "in_air": 1}


def test_a_message_that_is_refused_is_not_counted():
    world = World([0, 10], CommunicationMedium())
    with pytest.raises(CommunicationException):
        world.network.handle_command(SendMessageCommand("a", 7), world.nodes[0])
    assert set(world.ledger.message_outcomes()["unicast"].values()) == {0}


def test_a_new_simulation_starts_a_new_ledger():
    world = World([0, 10], CommunicationMedium())
    world.network.handle_command(BroadcastMessageCommand("a"), world.nodes[0])
    world.network.inject(EventLoop())
    assert world.ledger.message_outcomes()["broadcast"] == {"sent": 0}


@given(
    positions_m=st.lists(st.floats(0, 200), min_size=2, max_size=8),
    delay_s=st.sampled_from([0, 0.5, 2]),
    failure_rate=st.sampled_from([0, 0.5, 1]),
    sends=st.lists(st.tuples(st.floats(0, 5), st.integers(0, 7), st.none() | st.integers(0, 7)), max_size=20),
)
def test_the_sums_balance(positions_m, delay_s, failure_rate, sends):
    world = World(positions_m, CommunicationMedium(delay=delay_s, failure_rate=failure_rate))
    count = len(positions_m)
    copies = {"broadcast": 0, "unicast": 0}
    for time_s, sender, destination in sorted(sends, key=lambda send: send[0]):
        sender %= count
        if destination is not None and destination % count == sender:
            continue
        world.run(time_s)
        world.loop.advance_to(time_s)
        if destination is None:
            command, copies["broadcast"] = BroadcastMessageCommand("a"), copies["broadcast"] + count - 1
        else:
            command, copies["unicast"] = SendMessageCommand("a", destination % count), copies["unicast"] + 1
        world.network.handle_command(command, world.nodes[sender])
    world.run(5)
    world.loop.advance_to(5)
    outcomes = world.ledger.frame_outcomes()
    assert {kind: sum(counts.values()) for kind, counts in outcomes.items()} == copies
    assert sum(counts["delivered"] for counts in outcomes.values()) == world.received()
    assert min(min(counts.values()) for counts in outcomes.values()) >= 0


def test_what_is_sent_after_the_last_event_never_arrives():
    world = World([0, 10], CommunicationMedium())
    world.run()
    world.network.handle_command(SendMessageCommand("a", 1), world.nodes[0])
    outcomes = world.ledger.frame_outcomes()["unicast"]
    assert {name: count for name, count in outcomes.items() if count} == {"in_air": 1}
