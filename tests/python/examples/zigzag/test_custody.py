from hypothesis import given
from hypothesis import strategies as st

from custody import Custody


def test_data_given_to_a_peer_is_held_by_the_peer_alone() -> None:
    giver, taker = Custody(), Custody()
    giver.held = 12
    giver.give_all(2)
    assert taker.take(1, giver.given_to(2)) == 12
    assert (giver.held, taker.held) == (0, 12)


def test_a_message_that_comes_twice_adds_nothing() -> None:
    taker = Custody()
    taker.take(1, 12)
    assert taker.take(1, 12) == 0
    assert taker.held == 12


def test_an_old_message_that_comes_late_takes_nothing_away() -> None:
    taker = Custody()
    taker.take(1, 40)
    assert taker.take(1, 12) == 0
    assert (taker.held, taker.taken_from(1)) == (40, 40)


def test_what_a_lost_message_gave_comes_with_the_next_one() -> None:
    giver, taker = Custody(), Custody()
    giver.held = 12
    giver.give_all(2)  # the message is lost
    giver.held = 3
    giver.give_all(2)
    assert taker.take(1, giver.given_to(2)) == 15


def test_peers_have_separate_accounts() -> None:
    giver = Custody()
    giver.held = 12
    giver.give_all(2)
    assert (giver.given_to(2), giver.given_to(3)) == (12, 0)


@given(
    st.lists(st.tuples(st.integers(0, 2), st.integers(0, 2), st.integers(0, 5), st.booleans()), max_size=60)
)
def test_data_is_held_or_in_transit_whatever_is_lost(steps: list[tuple[int, int, int, bool]]) -> None:
    nodes = [Custody() for _ in range(3)]
    collected = 0
    for sender, receiver, fresh, arrives in steps:
        nodes[sender].held += fresh
        collected += fresh
        if sender == receiver:
            continue
        nodes[sender].give_all(receiver)
        if arrives:
            nodes[receiver].take(sender, nodes[sender].given_to(receiver))
        in_transit = [
            nodes[a].given_to(b) - nodes[b].taken_from(a) for a in range(3) for b in range(3) if a != b
        ]
        assert min(in_transit) >= 0
        assert sum(node.held for node in nodes) + sum(in_transit) == collected
