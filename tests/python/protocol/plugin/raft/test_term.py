from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.plugin.raft.term import next_own_term
from python.protocol.plugin.raft.term_owner import owner_of

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
