import pytest

from gradysim.protocol.plugin.raft.cluster import Cluster
from gradysim.protocol.plugin.raft.raft_message import RequestVote


@pytest.mark.parametrize(
    ("own", "other", "answer"), [(None, None, True), (4, 4, True), (4, None, False), (4, 5, False)]
)
def test_only_messages_of_the_same_cluster_are_accepted(own, other, answer):
    cluster = Cluster()
    cluster.cluster_id = own
    assert cluster.accepts(RequestVote(1, 2, cluster_id=other)) is answer


def test_what_was_heard_last_counts():
    cluster = Cluster()
    cluster.accepts(RequestVote(1, 2, cluster_id=5))
    before = cluster.has(2)
    cluster.accepts(RequestVote(1, 2))
    assert (before, cluster.has(2)) == (False, True)


def test_nothing_is_known_of_who_was_never_heard():
    cluster = Cluster()
    assert (cluster.knows(2), cluster.has(2)) == (False, False)
