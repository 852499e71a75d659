import pytest

from gradysim.protocol.plugin.raft import RaftMode, RaftState, node_report
from gradysim.protocol.plugin.raft.node_timers import ELECTION_TIMER
from gradysim.protocol.plugin.raft.raft_message import AppendEntries
from python.protocol.plugin.raft.modes import BOTH_MODES


@pytest.fixture
def network(network_type):
    network = network_type(5, 1, RaftMode.FAULT_TOLERANT)
    network.elect().propose("v", 42)
    network.run(0.5)
    return network


def follower_of(network):
    return next(node for node in network.nodes.values() if node is not network.leader)


def test_a_leader_sees_everybody(network):
    info = node_report.active_nodes_info(network.leader)
    leader_id, term = network.leader.node_id, network.leader.persistent.current_term
    summary = info.pop("detection_summary")
    assert summary["active_nodes"] == 4
    assert info == {
        "active_nodes": [0, 1, 2, 3, 4],
        "active_count": 5,
        "failed_nodes": [],
        "failed_count": 0,
        "total_known": 5,
        "majority_threshold": 3,
        "has_majority": True,
        "detection_method": "leader_heartbeat_detection",
        "last_update": network.now_s,
        "is_leader": True,
        "leader_id": leader_id,
        "current_node_id": leader_id,
        "current_term": term,
        "node_role": "leader",
        "raft_mode": "fault_tolerant",
    }


def test_a_follower_sees_what_its_leader_sees(network):
    crashed = follower_of(network).node_id
    network.crash(crashed)
    network.run(1.0)
    info = node_report.active_nodes_info(follower_of(network))
    assert (info["detection_method"], info["failed_nodes"]) == ("leader_shared_complete_list", [crashed])
    assert node_report.communication_failed_nodes(network.leader) == {crashed}


def test_a_follower_that_is_told_a_count_only(network):
    follower = follower_of(network)
    term = follower.persistent.current_term
    follower.handle_message(AppendEntries(term, follower.leader_id, {}, 0, 3).to_json())
    info = node_report.active_nodes_info(follower)
    assert (info["detection_method"], info["active_count"]) == ("leader_shared_count_only", 3)


def test_without_a_leader_a_node_believes_itself(network_type):
    network = network_type(3, 1, RaftMode.FAULT_TOLERANT)
    info = node_report.active_nodes_info(network.nodes[0])
    assert (info["detection_method"], info["last_update"]) == ("follower_local_detection", 0.0)


def test_in_classic_mode_everybody_counts_as_active(network_type):
    network = network_type(3, 1)
    network.crash(0)
    leader = network.elect()
    info = node_report.active_nodes_info(leader)
    assert (info["detection_method"], info["active_nodes"]) == ("classic_mode_all_active", [0, 1, 2])
    assert "not detected" in info["detection_summary"]


def test_the_majority_of_a_leader(network):
    info = node_report.majority_info(network.leader)
    assert (info["total_active"], info["majority_threshold"], info["confirmed_nodes"]) == (5, 3, 4)
    assert info["votes_received"] >= 3
    assert info["known_active_info"]["known_active_count"] is None


def test_the_majority_of_a_follower(network):
    info = node_report.majority_info(follower_of(network))
    assert (info["votes_received"], info["confirmed_nodes"]) == (0, 0)
    assert info["known_active_info"]["is_fresh"]
    assert info["known_active_info"]["known_active_count"] == 5


def test_a_candidate_has_its_own_vote(network_type):
    network = network_type(3, 1)
    node = network.nodes[0]
    node.handle_timer(ELECTION_TIMER)
    assert network.run(1.0, until=lambda: node.state is RaftState.CANDIDATE)
    assert node_report.votes_received(node) == 1


@pytest.mark.parametrize("question", ["has_majority_votes", "has_majority_confirmation"])
def test_only_a_leader_has_a_majority(network, question):
    ask = getattr(node_report, question)
    assert (ask(network.leader), ask(follower_of(network))) == (True, False)


@BOTH_MODES
@pytest.mark.parametrize(("count", "known", "answer"), [(1, False, False), (1, True, True), (2, True, True)])
def test_a_quorum_is_two_nodes_or_one_by_choice(network_type, mode, count, known, answer):
    assert node_report.has_quorum(network_type(count, 1, mode, known=known).nodes[0]) is answer


def test_the_state_of_a_node(network):
    info = node_report.state_info(network.leader)
    assert info["node_id"] == info["leader_id"] == info["voted_for"] == network.leader.node_id
    assert (info["state"], info["active_timers"]) == ("LEADER", ["heartbeat"])
    assert info["consensus_values"] == info["committed_values"] == {"v": 42, "w": None}
    assert (info["commit_index"], info["last_log_index"], info["known_nodes"]) == (2, 2, [0, 1, 2, 3, 4])


def test_the_statistics_of_a_node(network):
    statistics = node_report.statistics(network.leader)
    assert statistics == {
        "node_id": network.leader.node_id,
        "current_state": "LEADER",
        "current_term": network.leader.persistent.current_term,
        "is_leader": True,
        "leader_id": network.leader.node_id,
        "consensus_variables": ["v", "w"],
        "committed_values_count": 1,
        "active_timers_count": 1,
    }
