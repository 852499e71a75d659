import pytest

from gradysim.protocol.plugin.raft.membership import Membership, majority_of


@pytest.mark.parametrize(("count", "majority"), [(1, 1), (2, 2), (3, 2), (4, 3), (5, 3), (9, 5)])
def test_a_majority_is_more_than_half(count, majority):
    assert majority_of(count) == majority


def test_a_node_knows_itself():
    assert Membership(3).known == {3}


def test_members_grow_with_those_heard_of():
    membership = Membership(3)
    membership.learn([1, 2])
    assert (membership.known, membership.others) == ({1, 2, 3}, {1, 2})


def test_members_that_were_set_do_not_grow():
    membership = Membership(3)
    membership.fix([1])
    membership.learn([7])
    assert membership.known == {1, 3}


def test_strangers_count_only_while_members_are_not_set():
    membership = Membership(3)
    before = membership.accepts(7)
    membership.fix([1])
    assert (before, membership.accepts(7), membership.accepts(1)) == (True, False, True)


def test_a_node_is_alone_only_by_choice():
    membership = Membership(3)
    before = membership.is_alone_by_choice
    membership.fix([3])
    assert (before, membership.is_alone_by_choice) == (False, True)
