"""Who belongs to a node's cluster, what it hears, and how it is turned off and on."""

import pytest

from gradysim.protocol.plugin.raft import RaftMode, RaftState
from gradysim.protocol.plugin.raft.node_timers import ELECTION_TIMER
from gradysim.protocol.plugin.raft.raft_message import AppendEntries


def test_members_find_each_other(network_type):
    network = network_type(5, 1, known=False)
    network.elect()
    network.run(1.0)
    assert {node.membership.known for node in network.nodes.values()} == {frozenset(range(5))}


def test_strangers_are_not_heard(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    leader.handle_message(AppendEntries(10**6, 77, {}, 0).to_json())
    assert network.leader is leader


def test_other_clusters_are_not_heard(network_type):
    network = network_type(4, 1, RaftMode.FAULT_TOLERANT)
    for node in network.nodes.values():
        node.cluster.cluster_id = node.node_id % 2
    network.run(2.0)
    assert {node.node_id % 2 for node in network.leaders} == {0, 1}


def test_what_is_no_message_is_ignored(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    for text in ("", "garbage", "{}", '{"type": "RequestVote"}', "\u0000", "[" * 50):
        leader.handle_message(text)
    assert network.leader is leader


def test_who_plays_dead_is_silent(network_type):
    network = network_type(1, 1, known=False)
    network.nodes[0].set_active(False)
    network.run(2.0)
    network.nodes[0].send_text("text")
    assert (network.sent, network.nodes[0].timers.pending) == (0, set())


@pytest.mark.parametrize("leave", [lambda node: node.stop(), lambda node: node.set_active(False)])
def test_who_is_stopped_or_plays_dead_is_deaf(network_type, leave):
    network = network_type(3, 1)
    leader = network.elect()
    node = network.nodes[(leader.node_id + 1) % 3]
    leave(node)
    node.handle_message(AppendEntries(10**6, leader.node_id, {}, 0).to_json())
    assert (node.persistent.current_term, node.leader_id) == (leader.persistent.current_term, None)


def test_a_leader_that_plays_dead_gives_up_its_term(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    term = leader.persistent.current_term
    leader.set_active(False)
    assert (leader.state, leader.persistent.current_term) == (RaftState.FOLLOWER, term + 1)
    assert not leader.propose("v", 1)


def test_a_follower_that_plays_dead_keeps_its_term(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    follower = network.nodes[(leader.node_id + 1) % 3]
    for active in (False, True):
        follower.set_active(active)
    assert follower.persistent.current_term == leader.persistent.current_term


def test_who_rises_again_waits_for_a_leader_and_then_stands(network_type):
    node = network_type(3, 1).nodes[0]
    node.set_active(False)
    node.set_active(True)
    assert node.timers.pending == {ELECTION_TIMER}


def test_who_rises_again_takes_part(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    leader.set_active(False)
    network.run(2.0)
    leader.set_active(True)
    network.elect().propose("v", 42)
    assert network.run(1.0, until=lambda: network.agree_on("v", 42))


def test_who_was_stopped_goes_on_where_it_was(network_type):
    network = network_type(3, 1)
    node = network.elect()
    node.propose("v", 42)
    network.run(0.2)
    node.stop()
    network.run(2.0)
    values = dict(node.persistent.log.values)
    node.start()
    network.elect()
    assert (values, network.agree_on("v", 42)) == ({"v": 42}, True)


def test_no_two_nodes_send_at_the_same_time_for_long(network_type, faults_type):
    """Without any delay all followers hear a heartbeat at the same instant."""
    network = network_type(9, 1, faults=faults_type(delay_s=(0.0, 0.0)))
    network.elect()
    instants = []
    transmit = network.transmit
    network.transmit = lambda *arguments: (instants.append(network.now_s), transmit(*arguments))
    network.run(2.0)
    assert len(instants) == len(set(instants)) > 300
