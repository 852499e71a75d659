import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.plugin.follow_mobility.mobility import (
    BROADCAST_TIMER_TAG,
    FOLLOWER_TAG,
    FOLLOWER_TIMER_TAG,
    LEADER_TAG,
    FollowMobilityException,
    LeaderState,
    checked_orientation,
    decode_follower,
    decode_leader,
    encode_follower,
    encode_leader,
)

numbers = st.floats(allow_nan=False, allow_infinity=False)


def test_the_tags_are_the_published_ones():
    assert (LEADER_TAG, FOLLOWER_TAG) == ("FollowMobilityPlugin__leader", "FollowMobilityPlugin__follower")
    assert BROADCAST_TIMER_TAG == "FollowMobilityPlugin__leader_broadcast_timer"
    assert FOLLOWER_TIMER_TAG == "FollowMobilityPlugin__follower_timer"


def test_a_leaders_message_has_the_published_form():
    assert encode_leader(LeaderState(3, (1.0, 2.0, 3.0), 90.0)) == (
        'FollowMobilityPlugin__leader:{"id": 3, "position": [1.0, 2.0, 3.0], "orientation": 90.0}'
    )


def test_a_followers_message_has_the_published_form():
    assert encode_follower(7) == "FollowMobilityPlugin__follower:7"


@given(st.builds(LeaderState, st.integers(0), st.tuples(numbers, numbers, numbers), numbers))
def test_a_leaders_message_is_read_as_it_was_written(state):
    assert decode_leader(encode_leader(state)) == state


@given(st.integers(0))
def test_a_followers_message_is_read_as_it_was_written(identifier):
    assert decode_follower(encode_follower(identifier)) == identifier


def test_a_leader_need_not_have_an_orientation():
    message = LEADER_TAG + ':{"id": 3, "position": [1, 2, 3]}'
    assert decode_leader(message) == LeaderState(3, (1.0, 2.0, 3.0), 0.0)


@pytest.mark.parametrize(
    "payload",
    [
        "",
        "{",
        "[]",
        "5",
        "{}",
        '{"id": 1}',
        '{"id": "1", "position": [1, 2, 3]}',
        '{"id": true, "position": [1, 2, 3]}',
        '{"id": 1, "position": [1, 2]}',
        '{"id": 1, "position": [1, 2, NaN]}',
        '{"id": 1, "position": null}',
        '{"id": 1, "position": [1, 2, 3], "orientation": null}',
    ],
)
def test_another_payload_of_a_leader_is_refused(payload):
    with pytest.raises(FollowMobilityException, match=r"leader|orientation"):
        decode_leader(f"{LEADER_TAG}:{payload}")


@pytest.mark.parametrize("payload", ["", "x", "1.5", "{}"])
def test_another_payload_of_a_follower_is_refused(payload):
    with pytest.raises(FollowMobilityException, match="follower"):
        decode_follower(f"{FOLLOWER_TAG}:{payload}")


@pytest.mark.parametrize("orientation", [math.nan, math.inf, "90", None])
def test_an_orientation_is_a_finite_number(orientation):
    with pytest.raises(FollowMobilityException):
        checked_orientation(orientation)
