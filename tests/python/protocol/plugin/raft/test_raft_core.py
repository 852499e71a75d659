"""What all parts of a node share: who is a majority, which term it is, whether the leader is heard."""

import logging

import pytest

from gradysim.protocol.plugin.raft import RaftMode, RaftState
from gradysim.protocol.plugin.raft.node_timers import ELECTION_TIMER, HEARTBEAT_TIMER


@pytest.mark.parametrize(
    ("nodes", "electorate", "is_majority"),
    [
        ({0, 1}, {0, 1, 2}, True),
        ({0, 1}, {0, 1, 2, 3}, False),
        ({0, 1, 2}, {0, 1, 2, 3}, True),
        ({0, 8, 9}, {0, 1, 2}, False),  # strangers do not count
    ],
)
def test_a_majority_is_more_than_half_of_the_electorate(network_type, nodes, electorate, is_majority):
    node = network_type(3, 1).nodes[0]
    assert node.has_majority(nodes, frozenset(electorate)) == is_majority


@pytest.mark.parametrize("known", [True, False])
def test_one_alone_is_a_majority_only_if_it_was_set_to_be_alone(network_type, known):
    node = network_type(1, 1, known=known).nodes[0]
    assert node.has_majority({0}, frozenset({0})) == known


def follower_of(network):
    leader = network.elect()
    return next(node for node in network.nodes.values() if node is not leader)


def test_in_a_higher_term_vote_and_leader_are_forgotten(network_type):
    node = follower_of(network_type(3, 1))
    term = node.persistent.current_term
    node.persistent.voted_for = node.leader_id
    node.adopt_term(term + 1)
    assert node.persistent.current_term == term + 1
    assert (node.persistent.voted_for, node.leader_id, node.hears_leader()) == (None, None, False)


@pytest.mark.parametrize("step", [0, -1])
def test_a_term_that_is_not_higher_changes_nothing(network_type, step):
    """A vote that was forgotten could be given twice."""
    node = follower_of(network_type(3, 1))
    term, leader = node.persistent.current_term, node.leader_id
    node.persistent.voted_for = leader
    node.adopt_term(term + step)
    assert (node.persistent.current_term, node.persistent.voted_for, node.leader_id) == (term, leader, leader)


def test_a_leader_that_hears_of_a_higher_term_waits_for_another_one(network_type):
    leader = network_type(3, 1).elect()
    leader.adopt_term(leader.persistent.current_term + 1)
    assert (leader.state, leader.leadership) == (RaftState.FOLLOWER, None)
    assert HEARTBEAT_TIMER not in leader.timers.pending
    assert ELECTION_TIMER in leader.timers.pending


@pytest.mark.parametrize(("silence_s", "is_heard"), [(0.149, True), (0.151, False)])
def test_a_leader_is_heard_for_the_shortest_election_timeout(network_type, silence_s, is_heard):
    network = network_type(3, 1)
    node = follower_of(network)
    node.leader_heard_s = network.now_s
    network.now_s += silence_s
    assert node.hears_leader() == is_heard


def test_in_fault_tolerant_mode_those_decide_that_are_active(network_type):
    network = network_type(3, 1, RaftMode.FAULT_TOLERANT)
    leader = network.elect()
    away = next(node_id for node_id in network.nodes if node_id != leader.node_id)
    network.run(1.0)
    assert leader.electorate() == {0, 1, 2}
    network.crash(away)
    network.run(2.0)
    assert leader.electorate() == {0, 1, 2} - {away}


def test_lines_below_the_level_that_is_wanted_are_not_logged(network_type, caplog):
    network = network_type(1, 1)
    network.config.set_logging(True, "WARNING")
    caplog.set_level(logging.DEBUG)
    for level in (logging.INFO, logging.WARNING):
        network.nodes[0].log(level, "term %d", level)
    assert caplog.messages == ["Raft node 0: term 30"]
