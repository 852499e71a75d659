"""A voter: whom it refuses."""

import pytest

from gradysim.protocol.plugin.raft.raft_message import RequestVote


def test_who_hears_a_leader_does_not_vote_for_another(network_type):
    network = network_type(3, 1)
    leader = network.elect()
    follower, other = (node for node in network.nodes.values() if node is not leader)
    follower.handle_message(RequestVote(10**6, other.node_id, 10**6, 10**6).to_json())
    assert follower.persistent.current_term == leader.persistent.current_term


@pytest.mark.parametrize(("known", "granted"), [([0, 1, 2], True), ([1], False), (None, True)])
def test_while_members_are_found_who_knows_fewer_gets_no_vote(network_type, known, granted):
    network = network_type(3, 1, known=False)
    network.elect()
    network.run(1.0)
    voter = network.nodes[0]
    voter.adopt_term(10**6)  # whose leader is not known
    voter.handle_message(RequestVote(10**6, 1, 10**6, 10**6, known_nodes=known).to_json())
    assert (voter.persistent.voted_for == 1) is granted
