"""What a node tells about itself, as plain data."""

from typing import Any

from gradysim.protocol.plugin.raft.membership import majority_of
from gradysim.protocol.plugin.raft.raft_node import RaftNode
from gradysim.protocol.plugin.raft.raft_state import RaftState
from gradysim.protocol.plugin.raft.value import typed_value

_CLASSIC_SUMMARY = "Classic mode: every known node counts as active, failures are not detected"


def committed_values(node: RaftNode) -> dict[str, Any]:
    """The committed value of each configured variable, None where there is none."""
    return _of_variables(node, node.persistent.log.values)


def simulation_active_nodes(node: RaftNode) -> set[int]:
    """The members without the node itself while it plays dead; of others nobody knows."""
    return set(node.membership.known if node.is_active else node.membership.others)


def communication_active_nodes(node: RaftNode) -> set[int]:
    """The members that are taken for active because they answer."""
    return set(node.active_nodes())


def communication_failed_nodes(node: RaftNode) -> set[int]:
    """The members that are taken for failed because they do not answer; none in classic mode."""
    return set(node.membership.known - node.active_nodes())


def active_nodes(node: RaftNode) -> set[int]:
    """The members that are neither played dead nor taken for failed."""
    return simulation_active_nodes(node) & communication_active_nodes(node)


def shares_cluster_with(node: RaftNode, other_id: int) -> bool:
    """Whether another node is in the same cluster, by its last message; a silent one is if it is a member."""
    if other_id == node.node_id or not node.cluster.knows(other_id):
        return other_id in node.membership.known
    return node.cluster.has(other_id)


def has_quorum(node: RaftNode) -> bool:
    """Whether enough members are active for there to be a leader: two, or one that is all by choice."""
    return len(active_nodes(node)) >= 2 or (node.membership.is_alone_by_choice and node.is_active)


def has_majority_votes(node: RaftNode) -> bool:
    """Whether the node has won the election of the present term and still leads."""
    return node.leadership is not None


def has_majority_confirmation(node: RaftNode) -> bool:
    """Whether the node leads and the majority has everything in its log."""
    if node.leadership is None:
        return False
    confirming = node.leadership.confirming(node.persistent.log.last_index)
    return node.has_majority({*confirming, node.node_id}, node.electorate())


def votes_received(node: RaftNode) -> int:
    """How many nodes voted for the node in this term, itself among them; 0 unless it stands or leads."""
    if node.election is not None:
        return len(node.election.votes)
    return 0 if node.leadership is None else node.leadership.votes


def majority_info(node: RaftNode) -> dict[str, Any]:
    """How far the node is from a majority."""
    active = active_nodes(node)
    leadership = node.leadership
    confirming = set() if leadership is None else leadership.confirming(node.persistent.log.last_index)
    shared = node.activity.shared
    return {
        "active_nodes": sorted(active),
        "total_active": len(active),
        "majority_threshold": majority_of(len(active)),
        "has_majority": has_quorum(node),
        "votes_received": votes_received(node),
        "confirmed_nodes": len(confirming),
        "known_active_info": {
            "known_active_count": None if shared is None else shared.count,
            "is_fresh": node.activity.fresh_shared(node.lease_start_s()) is not None,
            "last_update": 0.0 if shared is None else shared.time_s,
        },
    }


def active_nodes_info(node: RaftNode) -> dict[str, Any]:
    """Which nodes are taken for active, and how that is known. `last_update` is s, 0 if there was none."""
    active = active_nodes(node)
    failed = simulation_active_nodes(node) - active
    method, last_update_s = _detection(node)
    count = len(active)
    shared = node.activity.shared
    if method == "leader_shared_count_only" and shared is not None:
        count = shared.count
    return {
        "active_nodes": sorted(active),
        "active_count": count,
        "failed_nodes": sorted(failed),
        "failed_count": len(failed),
        "total_known": len(node.membership.known),
        "majority_threshold": majority_of(count),
        "has_majority": has_quorum(node),
        "detection_method": method,
        "detection_summary": _CLASSIC_SUMMARY
        if node.config.is_classic_mode()
        else node.activity.detector.get_detection_summary(),
        "last_update": last_update_s,
        "is_leader": node.state is RaftState.LEADER,
        "leader_id": node.leader_id,
        "current_node_id": node.node_id,
        "current_term": node.persistent.current_term,
        "node_role": node.state.name.lower(),
        "raft_mode": node.config.get_raft_mode().value,
    }


def state_info(node: RaftNode) -> dict[str, Any]:
    """Everything about the node. `consensus_values` has what is proposed but not committed, too."""
    persistent = node.persistent
    return {
        "node_id": node.node_id,
        "state": str(node.state),
        "current_term": persistent.current_term,
        "voted_for": persistent.voted_for,
        "leader_id": node.leader_id,
        "consensus_values": _of_variables(node, persistent.log.latest_values()),
        "committed_values": committed_values(node),
        "commit_index": persistent.log.base_index,
        "last_log_index": persistent.log.last_index,
        "last_log_term": persistent.log.last_term,
        "known_nodes": sorted(node.membership.known),
        "active_timers": sorted(node.timers.pending),
        "cluster_id": node.cluster.cluster_id,
        "failure_detection": node.activity.detector.get_detection_summary(),
    }


def statistics(node: RaftNode) -> dict[str, Any]:
    """The most important of `state_info`."""
    return {
        "node_id": node.node_id,
        "current_state": str(node.state),
        "current_term": node.persistent.current_term,
        "is_leader": node.state is RaftState.LEADER,
        "leader_id": node.leader_id,
        "consensus_variables": list(node.config.get_consensus_variables()),
        "committed_values_count": sum(value is not None for value in committed_values(node).values()),
        "active_timers_count": len(node.timers.pending),
    }


def _of_variables(node: RaftNode, values: dict[str, Any]) -> dict[str, Any]:
    variables = node.config.get_consensus_variables()
    return {name: typed_value(kind, values.get(name)) for name, kind in variables.items()}


def _detection(node: RaftNode) -> tuple[str, float]:
    """How the active nodes are known, and when the node was last told or looked itself; s."""
    shared = node.activity.fresh_shared(node.lease_start_s())
    told_s = 0.0 if node.activity.shared is None else node.activity.shared.time_s
    if node.config.is_classic_mode():
        return "classic_mode_all_active", node.now_s() if node.leadership else told_s
    if node.leadership is not None:
        return "leader_heartbeat_detection", node.now_s()
    if shared is None:
        return "follower_local_detection", told_s
    return ("leader_shared_count_only" if shared.nodes is None else "leader_shared_complete_list"), told_s
