"""A follower: what it takes from its leader."""

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
