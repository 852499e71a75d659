import json
import logging

import pytest

from gradysim.protocol.messages.communication import CommunicationCommandType
from gradysim.protocol.plugin.raft import RaftConfig, RaftConsensusPlugin, RaftMode, RaftState
from gradysim.protocol.plugin.raft.raft_message import (
    AppendEntries,
    AppendEntriesResponse,
    DiscoveryHeartbeatResponse,
    RequestVoteResponse,
)
from gradysim.protocol.plugin.raft.raft_state import Entry
from python.protocol.plugin.raft.bare_provider import BareProvider
from python.quiet_protocol import Quiet


class Recorder(Quiet):
    def __init__(self):
        self.calls = []

    def handle_timer(self, timer):
        self.calls.append(timer)

    def handle_packet(self, message):
        self.calls.append(message)


@pytest.fixture
def provider():
    return BareProvider()


@pytest.fixture
def protocol(provider):
    return Recorder.instantiate(provider)


@pytest.fixture
def config():
    return (
        RaftConfig()
        .add_consensus_variable("v", int)
        .add_consensus_variable("path", tuple)
        .set_raft_mode(RaftMode.CLASSIC)
        .set_logging(False)
    )


@pytest.fixture
def plugin(config, protocol):
    plugin = RaftConsensusPlugin(config, protocol)
    plugin.set_known_nodes([1, 2, 3])
    plugin.start()
    return plugin


def send(protocol, message):
    protocol.handle_packet("__RAFT__:" + message.to_json())


def elect(plugin, protocol):
    protocol.handle_timer("__RAFT__:election_timeout")
    send(protocol, DiscoveryHeartbeatResponse(0, 1))
    send(protocol, RequestVoteResponse(plugin.get_current_term(), True, 1))


@pytest.fixture
def leader(plugin, protocol):
    elect(plugin, protocol)
    return plugin


@pytest.fixture
def tolerant_plugin(config, protocol):
    """Return a follower in fault-tolerant mode, of five nodes."""
    plugin = RaftConsensusPlugin(config.set_raft_mode(RaftMode.FAULT_TOLERANT), protocol)
    plugin.set_known_nodes(range(5))
    plugin.start()
    return plugin


@pytest.fixture
def tolerant_leader(tolerant_plugin, protocol):
    """Return a leader: nodes 0, 1 and 2 have its whole log; node 4 never answered."""
    protocol.handle_timer("__RAFT__:election_timeout")
    for node_id in range(3):
        send(protocol, DiscoveryHeartbeatResponse(0, node_id))
    for _ in range(6):
        protocol.handle_timer("__RAFT__:discovery_timeout")
    for node_id in range(3):
        send(protocol, RequestVoteResponse(tolerant_plugin.get_current_term(), True, node_id))
    tolerant_plugin.propose_value("v", 42)
    for node_id in range(3):
        send(protocol, AppendEntriesResponse(tolerant_plugin.get_current_term(), True, node_id, 2))
    return tolerant_plugin


def test_a_configuration_must_be_valid(protocol):
    with pytest.raises(ValueError, match="variable"):
        RaftConsensusPlugin(RaftConfig(), protocol)


def test_a_configuration_must_be_one(protocol):
    with pytest.raises(ValueError, match="RaftConfig"):
        RaftConsensusPlugin({"v": int}, protocol)


def test_a_protocol_must_have_its_provider(config):
    with pytest.raises(ValueError, match="provider"):
        RaftConsensusPlugin(config, Recorder())


def test_a_provider_must_have_what_is_needed(config, protocol, provider):
    provider.cancel_timer = None
    with pytest.raises(ValueError, match="cancel_timer"):
        RaftConsensusPlugin(config, protocol)


@pytest.mark.parametrize("node_id", [-1, "3", True, None])
def test_a_node_must_have_a_proper_id(config, node_id):
    with pytest.raises(ValueError, match=">= 0"):
        RaftConsensusPlugin(config, Recorder.instantiate(BareProvider(node_id)))


def test_timers_have_the_prefix_and_absolute_times(plugin, provider):
    assert 7.15 <= provider.timers["__RAFT__:election_timeout"] <= 7.3


def test_the_timers_of_the_published_package_are_there(plugin, protocol, provider):
    protocol.handle_timer("__RAFT__:election_timeout")
    discovering = set(provider.timers)
    send(protocol, DiscoveryHeartbeatResponse(0, 1))
    assert "__RAFT__:discovery_timeout" in discovering
    assert {"__RAFT__:heartbeat", "__RAFT__:election_timeout"} <= set(provider.timers)


def test_messages_have_the_prefix(leader, provider):
    messages = [json.loads(command.message.removeprefix("__RAFT__:")) for command in provider.sent]
    assert [message["type"] for message in messages] == ["DiscoveryHeartbeat", "RequestVote", "AppendEntries"]
    assert {message["sender_id"] for message in messages} == {3}
    assert messages[2]["consensus_values"] == {"v": None, "path": None}


def test_the_protocol_gets_only_what_is_its_own(plugin, protocol):
    for text in ("__RAFT__:garbage", "own"):
        protocol.handle_packet(text)
        protocol.handle_timer(text)
    assert protocol.calls == ["own", "own"]


def test_configuring_again_changes_nothing(leader, protocol, provider):
    leader.configure_handle_message()
    leader.configure_handle_timer()
    sent = len(provider.sent)
    protocol.handle_timer("__RAFT__:heartbeat")
    assert len(provider.sent) == sent + 1


def test_messages_and_timers_can_be_handed_over_by_hand(plugin):
    assert [plugin.handle_timer("own"), plugin.handle_message("own")] == [False, False]
    assert plugin.handle_timer("__RAFT__:election_timeout")
    assert plugin.handle_message("__RAFT__:" + DiscoveryHeartbeatResponse(0, 1).to_json())
    assert plugin.get_current_state() is RaftState.CANDIDATE


def test_a_follower_takes_no_proposal(plugin):
    assert plugin.propose_value("v", 1) is False


def test_a_leader_commits_what_the_majority_has(leader, protocol):
    assert leader.propose_value("v", 42) is True
    before = leader.get_committed_value("v")
    send(protocol, AppendEntriesResponse(leader.get_current_term(), True, 1, 2))
    assert (before, leader.get_committed_value("v")) == (None, 42)
    assert leader.get_all_committed_values() == {"v": 42, "path": None}
    assert leader.has_majority_confirmation()


def test_a_value_has_the_type_of_its_variable(leader, protocol):
    leader.propose_value("path", (1, 2))
    send(protocol, AppendEntriesResponse(leader.get_current_term(), True, 1, 2))
    assert leader.get_committed_value("path") == (1, 2)


@pytest.mark.parametrize("value", ["x", None, 1.0])
def test_a_proposal_of_another_type_is_an_error(plugin, value):
    with pytest.raises(ValueError, match="'v'"):
        plugin.propose_value("v", value)


@pytest.mark.parametrize("call", ["propose", "get"])
def test_an_unknown_variable_is_an_error(plugin, call):
    with pytest.raises(ValueError, match="'w'"):
        plugin.propose_value("w", 1) if call == "propose" else plugin.get_committed_value("w")


@pytest.mark.parametrize("ids", [["x"], [-1], [True], [1.5]])
def test_known_nodes_must_have_proper_ids(plugin, ids):
    with pytest.raises(ValueError, match=">= 0"):
        plugin.set_known_nodes(ids)


def test_a_leader_knows_that_it_is(leader):
    assert (leader.is_leader(), leader.get_leader_id(), leader.get_node_id()) == (True, 3, 3)
    assert (leader.get_current_term(), leader.get_current_state()) == (10, RaftState.LEADER)
    assert str(leader.get_current_state()) == "LEADER"


def test_stopping_ends_leadership(leader, provider):
    leader.stop()
    leader.stop()
    assert (leader.is_leader(), leader.get_leader_id(), provider.timers) == (False, None, {})


def test_send_broadcast_adds_the_prefix(plugin, provider):
    plugin.send_broadcast("hello")
    command = provider.sent[-1]
    assert (command.command_type, command.message) == (CommunicationCommandType.BROADCAST, "__RAFT__:hello")


def test_send_broadcast_takes_text_only(plugin):
    with pytest.raises(ValueError, match="5"):
        plugin.send_broadcast(5)


@pytest.mark.parametrize("setter", ["set_simulation_active", "set_is_active"])
def test_a_node_can_play_dead(leader, protocol, provider, setter):
    getattr(leader, setter)(3, False)
    provider.sent.clear()
    leader.send_broadcast("text")
    for timer in ("election_timeout", "heartbeat", "discovery_timeout", "reply"):
        protocol.handle_timer("__RAFT__:" + timer)
    send(protocol, AppendEntries(100, 1, {"v": 1}, 0))
    assert (provider.sent, leader.is_leader(), leader.get_current_term()) == ([], False, 11)
    assert (leader.get_is_active(3), leader.is_simulation_active(3)) == (False, False)
    assert (leader.get_simulation_active_nodes(), leader.get_active_nodes()) == ({1, 2}, {1, 2})


def test_a_node_that_played_dead_can_rise(plugin, provider):
    plugin.set_simulation_active(3, False)
    provider.timers.clear()
    plugin.set_simulation_active(3, True)
    assert (plugin.get_is_active(3), list(provider.timers)) == (True, ["__RAFT__:election_timeout"])


def test_of_others_nobody_can_say_whether_they_play_dead(plugin, caplog):
    with caplog.at_level(logging.WARNING):
        plugin.set_simulation_active(1, False)
    assert (plugin.get_is_active(1), plugin.is_simulation_active(99)) == (True, True)
    assert all(part in caplog.text for part in ("node 3 ", "node 1"))


def test_active_is_a_bool(plugin):
    with pytest.raises(ValueError, match="'no'"):
        plugin.set_simulation_active(3, "no")


@pytest.mark.parametrize("ask", ["get_failed_nodes", "get_communication_failed_nodes"])
def test_in_classic_mode_no_node_is_failed(plugin, ask):
    assert getattr(plugin, ask)() == set()


@pytest.mark.parametrize("ask", ["is_node_failed", "is_communication_failed"])
def test_a_node_is_failed_if_it_is_among_the_failed_ones(plugin, monkeypatch, ask):
    monkeypatch.setattr(plugin, "get_failed_nodes", lambda: {2})
    assert [getattr(plugin, ask)(node_id) for node_id in (1, 2)] == [False, True]


def test_clusters(plugin, protocol):
    plugin.set_known_nodes(range(5))
    plugin.set_cluster_id(4)
    send(protocol, RequestVoteResponse(0, False, 1, cluster_id=4))
    send(protocol, RequestVoteResponse(0, False, 2, cluster_id=5))
    same = {node_id for node_id in (1, 2, 3, 4, 99) if plugin.is_in_same_cluster(node_id)}
    assert (plugin.get_cluster_id(), same) == (4, {1, 3, 4})


@pytest.mark.parametrize("cluster_id", ["x", -1, True])
def test_a_cluster_has_a_proper_id(plugin, cluster_id):
    with pytest.raises(ValueError, match=">= 0"):
        plugin.set_cluster_id(cluster_id)


def test_the_configuration_can_be_asked_for(plugin, config):
    assert plugin.get_configuration() == config.to_dict()
    assert plugin.get_consensus_variables() == {"v": int, "path": tuple}
    assert (plugin.has_consensus_variable("v"), plugin.has_consensus_variable("w")) == (True, False)
    assert (plugin.get_consensus_variable_type("v"), plugin.get_consensus_variable_type("w")) == (int, None)
    assert plugin.is_ready()


def test_a_follower_takes_over_what_its_leader_has(plugin, protocol, provider):
    send(protocol, AppendEntries(2, 1, {"v": 7}, 5, 2, [1, 3], 4, 2, [Entry(2, "v", 8)]))
    protocol.handle_timer("__RAFT__:reply")
    answer = json.loads(provider.sent[-1].message.removeprefix("__RAFT__:"))
    assert (plugin.get_leader_id(), plugin.get_committed_value("v")) == (1, 7)
    assert (answer["success"], answer["term_number"], provider.sent[-1].destination) == (True, 5, 1)


def test_in_classic_mode_a_committed_value_is_not_given_up(plugin, protocol):
    send(protocol, AppendEntries(2, 1, {"v": 7}, 4, commit_index=4, commit_term=2))
    send(protocol, AppendEntries(5, 2, {}, 4, commit_index=4, commit_term=5))
    assert plugin.get_committed_value("v") == 7


# ---- reports ----


def test_a_leader_sees_the_nodes_that_answer(tolerant_leader):
    info = tolerant_leader.get_active_nodes_info()
    assert info.pop("detection_summary")["active_nodes"] == 3
    assert info == {
        "active_nodes": [0, 1, 2, 3],
        "active_count": 4,
        "failed_nodes": [4],
        "failed_count": 1,
        "total_known": 5,
        "majority_threshold": 3,
        "has_majority": True,
        "detection_method": "leader_heartbeat_detection",
        "last_update": 7.0,
        "is_leader": True,
        "leader_id": 3,
        "current_node_id": 3,
        "current_term": 10,
        "node_role": "leader",
        "raft_mode": "fault_tolerant",
    }
    assert tolerant_leader.get_communication_failed_nodes() == {4}


@pytest.mark.parametrize(
    ("nodes", "method", "active"),
    [
        ([0, 1, 3], "leader_shared_complete_list", [0, 1, 3]),
        (None, "leader_shared_count_only", [0, 1, 2, 3, 4]),
    ],
)
def test_a_follower_sees_what_its_leader_reports(tolerant_plugin, protocol, nodes, method, active):
    send(protocol, AppendEntries(2, 1, {}, 0, 3, nodes))
    info = tolerant_plugin.get_active_nodes_info()
    assert (info["detection_method"], info["active_nodes"]) == (method, active)
    assert (info["active_count"], info["last_update"]) == (3, 7.0)


def test_without_a_leader_a_node_believes_itself(tolerant_plugin):
    info = tolerant_plugin.get_active_nodes_info()
    assert (info["detection_method"], info["last_update"]) == ("follower_local_detection", 0.0)


def test_in_classic_mode_all_members_count_as_active(leader):
    info = leader.get_active_nodes_info()
    assert (info["detection_method"], info["active_nodes"]) == ("classic_mode_all_active", [1, 2, 3])
    assert isinstance(info["detection_summary"], str)


def test_the_majority_of_a_leader(tolerant_leader):
    info = tolerant_leader.get_majority_info()
    assert (info["total_active"], info["majority_threshold"], info["confirmed_nodes"]) == (4, 3, 3)
    assert info["votes_received"] == 3
    assert info["known_active_info"]["known_active_count"] is None


def test_the_majority_of_a_follower(tolerant_plugin, protocol):
    send(protocol, AppendEntries(2, 1, {}, 0, 5, list(range(5))))
    info = tolerant_plugin.get_majority_info()
    assert (info["votes_received"], info["confirmed_nodes"]) == (0, 0)
    assert info["known_active_info"] == {"known_active_count": 5, "is_fresh": True, "last_update": 7.0}


def test_a_candidate_has_its_own_vote(plugin, protocol):
    protocol.handle_timer("__RAFT__:election_timeout")
    send(protocol, DiscoveryHeartbeatResponse(0, 1))
    assert plugin.get_current_state() is RaftState.CANDIDATE
    assert plugin.get_majority_info()["votes_received"] == 1


def test_only_a_leader_has_a_majority(tolerant_leader, protocol):
    before = (tolerant_leader.has_majority_votes(), tolerant_leader.has_majority_confirmation())
    send(protocol, AppendEntries(99, 1, {}, 0))
    after = (tolerant_leader.has_majority_votes(), tolerant_leader.has_majority_confirmation())
    assert (before, after) == ((True, True), (False, False))


@pytest.mark.parametrize("mode", RaftMode)
@pytest.mark.parametrize(("known", "answer"), [(None, False), ([3], True), ([1, 3], True)])
def test_a_quorum_is_two_nodes_or_one_that_was_set_to_be_alone(config, protocol, mode, known, answer):
    plugin = RaftConsensusPlugin(config.set_raft_mode(mode), protocol)
    if known is not None:
        plugin.set_known_nodes(known)
    assert plugin.has_quorum() is answer


def test_the_state_of_a_node(tolerant_leader):
    info = tolerant_leader.get_state_info()
    assert info["node_id"] == info["leader_id"] == info["voted_for"] == 3
    assert (info["state"], info["active_timers"]) == ("LEADER", ["heartbeat"])
    assert info["consensus_values"] == info["committed_values"] == {"v": 42, "path": None}
    assert (info["commit_index"], info["last_log_index"], info["known_nodes"]) == (2, 2, [0, 1, 2, 3, 4])


def test_the_statistics_of_a_node(tolerant_leader):
    assert tolerant_leader.get_statistics() == {
        "node_id": 3,
        "current_state": "LEADER",
        "current_term": 10,
        "is_leader": True,
        "leader_id": 3,
        "consensus_variables": ["v", "path"],
        "committed_values_count": 1,
        "active_timers_count": 1,
    }
