import copy
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.plugin.raft.raft_log import Entry, RaftLog


def log_of(*terms, committed=0):
    """A log of entries ("v", its number) with those terms."""
    log = RaftLog()
    for number, term in enumerate(terms, start=1):
        log.append(Entry(term, "v", number))
    log.commit(committed)
    return log


def terms_of(log):
    return [log.term_at(index) for index in range(log.base_index, log.last_index + 1)]


def test_an_empty_log_ends_at_0():
    log = RaftLog()
    assert (log.last_index, log.last_term, log.term_at(0)) == (0, 0, 0)


def test_appending_numbers_from_1():
    assert RaftLog().append(Entry(3, "v", 1)) == 1


def test_committing_folds_values():
    log = log_of(1, 1, 2, committed=2)
    assert (log.values, log.base_index, log.base_term, len(log.entries)) == ({"v": 2}, 2, 1, 1)


def test_committing_twice_changes_nothing():
    log = log_of(1, 1, 2, committed=2)
    log.commit(1)
    assert log.base_index == 2


def test_an_entry_without_a_name_changes_no_value():
    log = RaftLog()
    log.append(Entry(1, None, None))
    log.commit(1)
    assert log.values == {}


def test_latest_values_have_what_is_not_committed():
    assert log_of(1, 1, committed=1).latest_values() == {"v": 2}


@pytest.mark.parametrize(
    ("last_index", "last_term", "answer"),
    [(3, 2, True), (2, 2, False), (1, 3, True), (9, 1, False), (4, 2, True)],
)
def test_what_is_up_to_date(last_index, last_term, answer):
    assert log_of(1, 1, 2).is_up_to_date(last_index, last_term) is answer


def test_a_follower_takes_what_it_lacks():
    log = log_of(1)
    log.follow(log_of(1, 1, 2))
    assert terms_of(log) == [0, 1, 1, 2]


def test_a_follower_drops_what_differs():
    log = log_of(1, 2, 2, 2)
    log.follow(log_of(1, 3))
    assert terms_of(log) == [0, 1, 3]


def test_a_late_message_takes_nothing_away():
    log = log_of(1, 1, 1)
    log.follow(log_of(1, 1))
    assert log.last_index == 3


def test_a_follower_commits_what_its_leader_has():
    log = log_of(1, 1)
    log.follow(log_of(1, 1, 1, committed=2))
    assert (log.base_index, log.last_index) == (2, 3)


def test_a_follower_far_behind_takes_the_values():
    log = log_of(1, 2)
    log.follow(log_of(1, 3, 3, 3, committed=3))
    assert (log.values, terms_of(log)) == ({"v": 3}, [3, 3])


def test_a_follower_ahead_in_commits_loses_none():
    log = log_of(1, 1, 1, committed=3)
    log.follow(log_of(1, 1, 1, 4, committed=1))
    assert (log.base_index, terms_of(log)) == (3, [1, 4])


@pytest.mark.parametrize(
    ("leader", "answer"),
    [
        (log_of(1, 1, 2), False),
        (log_of(1, 3), True),
        (log_of(1, 1, 2, 3, committed=4), False),
        (log_of(1, 1), False),
        (log_of(3), True),
    ],
)
def test_contradicting_what_was_committed(leader, answer):
    assert log_of(1, 1, committed=2).contradicts(leader) is answer


def test_who_follows_in_spite_of_a_contradiction_has_the_leaders_log():
    log = log_of(1, 1, committed=2)
    log.follow(log_of(3))
    assert (log.base_index, log.values, terms_of(log)) == (0, {}, [0, 3])


@given(st.integers(0, 2**32), st.integers(1, 12))
def test_messages_of_one_leader_in_any_order_give_its_log(seed, count):
    """Whatever a follower had that was not committed, and however often and in what order it hears."""
    stream = Random(seed)
    leader = log_of(1, 1, committed=stream.randint(0, 2))
    follower = log_of(1, *[2] * stream.randint(0, 4))
    sent = []
    for number in range(count):
        leader.append(Entry(3, "v", 100 + number))
        if stream.random() < 0.5:
            leader.commit(stream.randint(leader.base_index, leader.last_index))
        sent.append(copy.deepcopy(leader))
    sent += stream.choices(sent, k=3)
    stream.shuffle(sent)
    for message in sent:
        assert not follower.contradicts(message)
        follower.follow(message)
    assert follower.latest_values() == leader.latest_values()
    assert (follower.last_index, follower.base_index) == (leader.last_index, leader.base_index)
