"""Who comes to lead, and who does not."""

import json

import pytest

from gradysim.protocol.plugin.raft import RaftMode, RaftState
from gradysim.protocol.plugin.raft.node_timers import ELECTION_TIMER
from python.protocol.plugin.raft.modes import BOTH_MODES
from python.protocol.plugin.raft.term_owner import owner_of


@BOTH_MODES
@pytest.mark.parametrize("known", [True, False])
def test_a_leader_is_elected(network_type, mode, known):
    network = network_type(5, 1, mode, known=known)
    leader = network.elect(within_s=1.0)
    assert owner_of(leader.persistent.current_term) == leader.node_id


@BOTH_MODES
def test_who_has_heard_all_members_stands_at_once(network_type, mode):
    network = network_type(3, 1, mode)
    network.nodes[0].handle_timer(ELECTION_TIMER)
    # All rounds of looking round take 200 ms; two answers to a broadcast, 50 ms at most each.
    assert network.run(0.1, until=lambda: network.leader is network.nodes[0])


def test_a_candidate_without_votes_does_not_lead(network_type):
    network = network_type(3, 1)
    transmit = network.transmit
    network.transmit = lambda source, message, destination: (
        None if '"RequestVote"' in message else transmit(source, message, destination)
    )
    assert network.run(1.0, until=lambda: any(map(is_candidate, network.nodes.values())))
    network.run(2.0)
    assert network.leaders == []


def is_candidate(node):
    return node.state is RaftState.CANDIDATE


def test_a_leader_heeds_no_election_timeout(network_type):
    leader = network_type(3, 1).elect()
    leader.handle_timer(ELECTION_TIMER)
    assert leader.leader_id == leader.node_id


@BOTH_MODES
def test_after_the_leader_crashes_there_is_another(network_type, mode):
    network = network_type(5, 1, mode)
    first = network.elect()
    first.propose("v", 42)
    network.run(0.2)
    network.crash(first.node_id)
    second = network.elect()
    assert (second.node_id != first.node_id, second.persistent.log.values) == (True, {"v": 42})


def test_in_fault_tolerant_mode_the_last_but_one_failure_still_leaves_a_leader(network_type):
    network = network_type(5, 1, RaftMode.FAULT_TOLERANT)
    network.elect()
    for node_id in (0, 1, 2):
        network.crash(node_id)
        network.run(2.0)
    assert network.elect().propose("v", 42)


def test_in_fault_tolerant_mode_the_last_node_does_not_lead(network_type):
    network = network_type(3, 1, RaftMode.FAULT_TOLERANT)
    network.elect()
    network.crash(0)
    network.crash(1)
    network.run(5.0)
    assert network.leaders == []


@BOTH_MODES
def test_a_node_that_was_set_to_be_alone_leads(network_type, mode):
    network = network_type(1, 1, mode)
    network.rules.check = lambda node: None  # they look at entries before they are committed
    assert network.elect().propose("v", 42)
    assert network.agree_on("v", 42)


def test_a_node_that_was_set_to_be_alone_asks_nobody_for_votes(network_type):
    network = network_type(1, 1)
    sent = []
    network.transmit = lambda source, message, destination: sent.append(json.loads(message)["type"])
    network.nodes[0].handle_timer(ELECTION_TIMER)
    assert sent == ["AppendEntries"]


@BOTH_MODES
def test_a_node_that_finds_nobody_does_not_lead(network_type, mode):
    network = network_type(1, 1, mode, known=False)
    network.run(5.0)
    assert network.leaders == []


def test_a_lonely_node_does_not_raise_its_term(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    lonely = next(node for node in network.nodes.values() if node is not leader)
    network.partition([lonely.node_id])
    network.run(10.0)
    assert lonely.persistent.current_term == leader.persistent.current_term
    network.partition()
    network.run(1.0)
    assert network.leader is leader


@BOTH_MODES
@pytest.mark.parametrize("known", [True, False])
def test_long_delays_need_long_timeouts_only(network_type, faults_type, mode, known):
    network = network_type(5, 1, mode, faults_type(delay_s=(0.1, 0.1)), known=known)
    network.config.set_election_timeout(1000, 2000).set_heartbeat_interval(300)
    leader = network.elect(within_s=20.0)
    assert leader.propose("v", 42)
    assert network.run(1.0, until=lambda: network.agree_on("v", 42))
