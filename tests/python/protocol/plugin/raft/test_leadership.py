import pytest

from gradysim.protocol.plugin.raft.leadership import Leadership
from gradysim.protocol.plugin.raft.raft_log import Entry, RaftLog

EVERYBODY = {0, 1, 2, 3, 4}


def leadership_with(matched):
    leadership = Leadership(0, 3, 10.0, {0, 1, 2})
    for node_id, index in matched.items():
        leadership.matches(node_id, index)
    return leadership


def log_of(*terms):
    return RaftLog(entries=[Entry(term, "v", number) for number, term in enumerate(terms)])


@pytest.mark.parametrize(
    ("matched", "index"),
    [({}, 0), ({1: 3}, 0), ({1: 3, 2: 3}, 3), ({1: 4, 2: 3}, 3), ({1: 4, 2: 4, 3: 1, 4: 1}, 4)],
)
def test_what_the_majority_has_may_be_committed(matched, index):
    assert leadership_with(matched).committable(log_of(1, 2, 3, 3), EVERYBODY) == index


def test_entries_of_earlier_terms_do_not_count():
    assert leadership_with({1: 2, 2: 2}).committable(log_of(1, 2, 3), EVERYBODY) == 0


def test_only_the_electorate_counts():
    assert leadership_with({3: 1, 4: 1}).committable(log_of(3), {0, 1, 2}) == 0


def test_the_votes_are_those_of_the_election():
    assert Leadership(0, 3, 10.0, {0, 1, 2}).votes == 3


def test_late_answers_take_nothing_back():
    leadership = leadership_with({1: 4})
    leadership.matches(1, 2)
    assert (leadership.confirming(4), leadership.confirming(5)) == ({1}, set())


def test_voters_count_as_heard():
    assert leadership_with({}).heard_since(10.0) == {0, 1, 2}


def test_who_was_heard_since():
    leadership = leadership_with({})
    leadership.heard(4, 11.0)
    assert leadership.heard_since(10.5) == {0, 4}
