"""A leader: proposals, commits, and when it resigns."""

import pytest

from gradysim.protocol.plugin.raft import RaftMode, RaftState
from python.protocol.plugin.raft.modes import BOTH_MODES


@BOTH_MODES
def test_a_leader_stays_while_all_is_well(network_type, mode):
    network = network_type(5, 1, mode)
    network.elect()
    network.run(20.0)
    assert len(network.rules.leaders) == 1


@BOTH_MODES
def test_a_leader_stays_with_a_fifth_of_the_messages_lost(network_type, faults_type, mode):
    network = network_type(9, 1, mode, faults_type(loss=0.2, delay_s=(0.01, 0.01)))
    network.elect()
    network.run(20.0)
    assert len(network.rules.leaders) == 1


@BOTH_MODES
def test_a_proposal_is_committed_everywhere(network_type, mode):
    network = network_type(5, 1, mode)
    assert network.elect().propose("v", 42)
    assert network.run(0.2, until=lambda: network.agree_on("v", 42))


def test_a_proposal_does_not_wait_for_the_next_heartbeat(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    before = network.sent
    leader.propose("v", 42)
    assert network.sent == before + 1


def test_only_a_leader_takes_proposals(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    assert [node.propose("v", 1) for node in network.nodes.values() if node is not leader] == [False, False]


def test_proposing_what_holds_adds_nothing(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    leader.propose("v", 1)
    network.run(0.2)
    before = leader.persistent.log.last_index
    assert leader.propose("v", 1)
    assert leader.persistent.log.last_index == before


def test_a_value_of_another_type_is_another_value(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    leader.propose("v", 1)
    leader.propose("v", True)
    network.run(0.2)
    assert leader.persistent.log.values["v"] is True


def test_the_log_does_not_grow(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    for number in range(200):
        leader.propose("v", number)
        network.run(0.1)
    assert max(len(node.persistent.log.entries) for node in network.nodes.values()) <= 1


@pytest.mark.parametrize("majority", [True, False])
def test_in_classic_mode_only_a_majority_goes_on(network_type, majority):
    network = network_type(5, 1)
    leader = network.elect()
    others = [node_id for node_id in network.nodes if node_id != leader.node_id]
    network.partition([leader.node_id, *others[: 2 if majority else 1]])
    network.run(2.0)
    assert leader.propose("v", 42) is majority
    network.run(0.3)
    assert (leader.persistent.log.values == {"v": 42}) is majority


def test_in_classic_mode_a_leader_without_a_majority_resigns(network_type):
    network = network_type(5, 1)
    leader = network.elect()
    network.partition([leader.node_id])
    network.run(1.0)
    assert (leader.state, leader.leader_id) == (RaftState.FOLLOWER, None)


@pytest.mark.parametrize("seed", range(10))
def test_in_fault_tolerant_mode_both_sides_go_on_in_terms_of_their_own(network_type, seed):
    network = network_type(9, seed, RaftMode.FAULT_TOLERANT)
    network.elect()
    network.partition(range(4))
    network.run(4.0)
    leaders = network.leaders
    assert {node.node_id < 4 for node in leaders} == {True, False}
    assert len({node.persistent.current_term for node in leaders}) == len(leaders) == 2
    for node in leaders:
        assert node.propose("v", node.node_id)
    network.run(0.5)
    assert all(node.persistent.log.values == {"v": node.node_id} for node in leaders)
    network.check_recovery()


@BOTH_MODES
def test_a_leader_that_always_proposes_notices_that_nobody_answers(network_type, mode):
    network = network_type(3, 1, mode)
    leader = network.elect()
    network.partition([leader.node_id])
    for number in range(200):
        leader.propose("v", number)
        network.run(0.01)
    assert leader.state is RaftState.FOLLOWER


def test_committing_needs_the_majority_of_members_set_later(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    leader.set_known_nodes(range(100))
    leader.propose("v", 42)
    network.run(0.04)  # all have answered; later another node, which counts three members, may commit it
    assert leader.persistent.log.values == {}
