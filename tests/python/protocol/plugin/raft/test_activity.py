import pytest

from gradysim.protocol.plugin.raft import FailureConfig
from gradysim.protocol.plugin.raft.activity import Activity, SharedView
from gradysim.protocol.plugin.raft.membership import Membership


@pytest.fixture
def membership():
    membership = Membership(0)
    membership.fix([1, 2, 3])
    return membership


@pytest.fixture
def activity(membership):
    config = FailureConfig()
    config.set_absolute_timeout(200)
    return Activity(0, membership, config, lambda: 5.0)


def test_members_are_taken_for_active_at_first(activity):
    assert activity.detected() == {0, 1, 2, 3}


def test_a_new_leader_takes_those_for_active_that_it_saw(activity):
    activity.begin_to_lead({0, 2})
    assert activity.detected() == {0, 2}


def test_a_new_leader_forgets_the_failures_that_it_knew_of(activity):
    activity.begin_to_lead({0})
    activity.begin_to_lead({0, 2})
    assert activity.detected() == {0, 2}


def test_members_that_come_and_go_are_watched(activity, membership):
    membership.fix([2, 7])
    activity.watch_members()
    assert activity.detected() == {0, 2, 7}


def test_a_follower_believes_its_leader(activity):
    activity.shared = SharedView(3, frozenset({1, 2, 9}), 5.0)
    assert activity.seen_by_follower(4.5) == {0, 1, 2}


@pytest.mark.parametrize("shared", [SharedView(2, frozenset({1}), 4.0), SharedView(2, None, 5.0), None])
def test_without_fresh_names_a_follower_believes_itself(activity, shared):
    activity.shared = shared
    assert activity.seen_by_follower(4.5) == {0, 1, 2, 3}
