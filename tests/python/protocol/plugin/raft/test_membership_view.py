"""Nodes that a node considers members, of the same cluster, and active."""

import pytest

from gradysim.protocol.plugin.raft import FailureConfig
from gradysim.protocol.plugin.raft.membership_view import LeaderView, MembershipView
from gradysim.protocol.plugin.raft.raft_message import RequestVote


@pytest.fixture
def view():
    config = FailureConfig()
    config.set_absolute_timeout(200)
    return MembershipView(0, config, lambda: 5.0)


@pytest.fixture
def fixed_view(view):
    view.fix([1, 2, 3])
    return view


def test_a_node_knows_itself(view):
    assert (view.known, view.others) == ({0}, set())


def test_members_grow_with_those_heard_of(view):
    view.learn([1, 2])
    assert (view.known, view.others) == ({0, 1, 2}, {1, 2})


def test_members_that_were_set_do_not_grow(fixed_view):
    fixed_view.learn([7])
    assert fixed_view.known == {0, 1, 2, 3}


def test_strangers_count_only_while_members_are_not_set(view):
    before = view.accepts(RequestVote(1, 7))
    view.fix([1])
    assert (before, view.accepts(RequestVote(1, 7)), view.accepts(RequestVote(1, 1))) == (True, False, True)


def test_a_node_ignores_its_own_messages(view):
    assert not view.accepts(RequestVote(1, 0))


def test_a_node_is_single_only_if_it_was_set_so(view):
    before = view.is_single_node
    view.fix([0])
    assert (before, view.is_single_node) == (False, True)


@pytest.mark.parametrize(
    ("own", "other", "answer"), [(None, None, True), (4, 4, True), (4, None, False), (4, 5, False)]
)
def test_only_messages_of_the_same_cluster_are_accepted(view, own, other, answer):
    view.cluster_id = own
    assert view.accepts(RequestVote(1, 2, cluster_id=other)) is answer


def test_the_latest_message_tells_the_cluster(view):
    view.accepts(RequestVote(1, 2, cluster_id=5))
    before = view.shares_cluster_with(2)
    view.accepts(RequestVote(1, 2))
    assert (before, view.shares_cluster_with(2)) == (False, True)


def test_a_node_that_was_never_heard_shares_the_cluster_if_it_is_a_member(fixed_view):
    assert [fixed_view.shares_cluster_with(node_id) for node_id in (0, 2, 7)] == [True, True, False]


def test_members_are_active_at_first(fixed_view):
    assert fixed_view.detected() == {0, 1, 2, 3}


def test_a_new_leader_starts_with_the_nodes_that_it_saw(fixed_view):
    fixed_view.start_leading({0})
    first = fixed_view.detected()
    fixed_view.start_leading({0, 2})
    assert (first, fixed_view.detected()) == ({0}, {0, 2})


def test_new_members_are_watched_and_former_ones_are_not(fixed_view):
    fixed_view.fix([2, 7])
    assert fixed_view.detected() == {0, 2, 7}


def test_a_follower_believes_its_leader(fixed_view):
    fixed_view.leader_view = LeaderView(3, frozenset({1, 2, 9}), 5.0)
    assert fixed_view.active_for_follower(4.5) == {0, 1, 2}


@pytest.mark.parametrize("report", [LeaderView(2, frozenset({1}), 4.0), LeaderView(2, None, 5.0), None])
def test_without_a_fresh_report_a_follower_believes_its_own_detector(fixed_view, report):
    fixed_view.leader_view = report
    assert fixed_view.active_for_follower(4.5) == {0, 1, 2, 3}
