"""A voter: whom it refuses."""

from gradysim.protocol.plugin.raft.raft_message import RequestVote


def test_who_hears_a_leader_does_not_vote_for_another(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    follower, other = (node for node in network.nodes.values() if node is not leader)
    follower.handle_message(RequestVote(10**6, other.node_id, 10**6, 10**6).to_json())
    assert follower.persistent.current_term == leader.persistent.current_term
