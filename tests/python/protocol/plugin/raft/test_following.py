"""A follower: what it takes from its leader."""

import pytest

from gradysim.protocol.plugin.raft import RaftMode
from gradysim.protocol.plugin.raft.raft_log import RaftLog
from gradysim.protocol.plugin.raft.raft_message import AppendEntries


def test_who_was_away_catches_up(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    away = next(node_id for node_id in network.nodes if node_id != leader.node_id)
    network.crash(away)
    for number in range(50):
        leader.propose("v", number)
        network.run(0.06)
    network.restart(away)
    assert network.run(1.0, until=lambda: network.agree_on("v", 49))


def test_a_stale_leader_is_refused(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    follower = next(node for node in network.nodes.values() if node is not leader)
    stale = next(node for node in network.nodes.values() if node not in (leader, follower))
    follower.handle_message(AppendEntries(0, stale.node_id, {"v": 13}, 0).to_json())
    assert follower.leader_id == leader.node_id


@pytest.mark.parametrize(("mode", "value"), [(RaftMode.CLASSIC, 1), (RaftMode.FAULT_TOLERANT, 2)])
def test_only_in_classic_mode_what_is_committed_is_kept_against_a_leader(network_type, mode, value):
    node = network_type(3, 1, mode).nodes[0]
    node.persistent.log = RaftLog(base_index=5, base_term=2, values={"v": 1})
    leader = AppendEntries(9, 1, {"v": 2}, 5, commit_index=5, commit_term=3)
    node.handle_message(leader.to_json())
    assert node.persistent.log.values == {"v": value}
