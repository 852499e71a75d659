"""The log, the state of a leader, the terms that a node owns, and values in JSON."""

import copy
import enum
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.plugin.raft.raft_state import (
    Entry,
    Leadership,
    RaftLog,
    json_value,
    majority_of,
    next_own_term,
    same_value,
    typed_value,
)
from python.protocol.plugin.raft.term_owner import owner_of


def log_of(*terms, committed=0):
    """Return a log of entries ("v", number) with those terms."""
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
    """For any uncommitted entries of the follower, and any order and repetition of messages."""
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


EVERYBODY = {0, 1, 2, 3, 4}


def leadership_with(matched):
    leadership = Leadership(0, 3, 10.0, {0, 1, 2})
    for node_id, index in matched.items():
        leadership.matches(node_id, index)
    return leadership


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


@pytest.mark.parametrize(("count", "majority"), [(1, 1), (2, 2), (3, 2), (4, 3), (5, 3), (9, 5)])
def test_a_majority_is_more_than_half(count, majority):
    assert majority_of(count) == majority


IDS = st.integers(0, 300)
TERMS = st.integers(0, 100_000)


def test_the_first_rows_are_as_documented():
    assert [owner_of(term) for term in range(1, 7)] == [0, 0, 1, 0, 1, 2]


@given(TERMS, IDS)
def test_a_node_gets_a_higher_term(current, node_id):
    assert next_own_term(current, node_id) > current


@given(TERMS, IDS)
def test_a_node_gets_a_term_of_its_own(current, node_id):
    assert owner_of(next_own_term(current, node_id)) == node_id


@given(st.integers(0, 500), st.integers(0, 30))
def test_no_term_of_its_own_is_skipped(current, node_id):
    following = next_own_term(current, node_id)
    assert node_id not in [owner_of(term) for term in range(current + 1, following)]


def test_terms_of_few_nodes_stay_small():
    term = 0
    for node_id in [8, 0, 3, 8, 1] * 4:
        term = next_own_term(term, node_id)
    assert term < 400


class Colour(enum.IntEnum):
    RED = 1


@pytest.mark.parametrize(
    "value", [1, True, 1.5, "text", [1, [2]], (1, 2), {"a": [1]}, ""], ids=lambda value: repr(value)
)
def test_a_value_arrives_as_it_was(value):
    kind = type(value)
    assert typed_value(kind, json_value("v", kind, value)) == value


@pytest.mark.parametrize(
    ("value", "arrives"),
    [
        ((1, (2, 3)), (1, [2, 3])),
        ([(1, 2)], [[1, 2]]),
        ([Colour.RED], [1]),
        ({1: (2, 3)}, {"1": [2, 3]}),
        ({True: 1, None: 2, 1.5: 3}, {"true": 1, "null": 2, "1.5": 3}),
    ],
    ids=repr,
)
def test_what_is_inside_arrives_as_json_has_it(value, arrives):
    kind = type(value)
    shown = typed_value(kind, json_value("v", kind, value))
    assert (type(shown), repr(shown)) == (kind, repr(arrives))


@given(st.recursive(st.integers() | st.text() | st.floats(allow_nan=False), lambda inner: st.lists(inner)))
def test_any_value_that_json_has_arrives_as_it_was(value):
    assert typed_value(object, json_value("v", object, value)) == value


def test_a_value_is_a_copy():
    value = [1]
    carried = json_value("v", list, value)
    value.append(2)
    assert carried == [1]


def test_what_is_read_is_a_copy():
    carried = [1]
    typed_value(list, carried).append(2)
    assert carried == [1]


@pytest.mark.parametrize(
    ("kind", "value"),
    [
        (int, "x"),
        (float, 1),
        (int, None),
        (set, {1}),
        (bytes, b"x"),
        (Colour, Colour.RED),
    ],
)
def test_a_value_that_json_changes_is_an_error(kind, value):
    with pytest.raises(ValueError, match="'v'"):
        json_value("v", kind, value)


@pytest.mark.parametrize(
    ("first", "second", "answer"),
    [
        (1, 1, True),
        (1, 1.0, False),
        (1, True, False),
        ([1], [True], False),
        ({"a": 1, "b": 2}, {"b": 2, "a": 1}, True),
    ],
)
def test_which_values_are_the_same(first, second, answer):
    assert same_value(first, second) is answer
