"""Messages between leaders and followers: tags of timers and messages, formats, and the exception of both.

A leader broadcasts `LEADER_TAG:{"id": 0, "position": [x, y, z], "orientation": degrees}`; a follower answers
with `FOLLOWER_TAG:id`, to its leader alone.
"""

import json
from functools import lru_cache
from typing import NamedTuple

from gradysim.protocol.checked_values import checked_number, checked_point
from gradysim.protocol.position import Position

LEADER_TAG = "FollowMobilityPlugin__leader"
FOLLOWER_TAG = "FollowMobilityPlugin__follower"
BROADCAST_TIMER_TAG = "FollowMobilityPlugin__leader_broadcast_timer"
FOLLOWER_TIMER_TAG = "FollowMobilityPlugin__follower_timer"

LEADER_PREFIX = f"{LEADER_TAG}:"
FOLLOWER_PREFIX = f"{FOLLOWER_TAG}:"


class FollowMobilityException(Exception):  # noqa: N818 (the published name)
    """A leader is not available, a value is out of range, or a message is malformed."""


class LeaderState(NamedTuple):
    """What a leader broadcasts: id, position (m) and orientation (degrees)."""

    id: int
    position: Position
    orientation: float


def encode_leader(state: LeaderState) -> str:
    """Return the broadcast of a leader."""
    return LEADER_PREFIX + json.dumps(state._asdict())


@lru_cache(maxsize=64)  # all followers decode the same broadcast
def decode_leader(message: str) -> LeaderState:
    """Return the state in the broadcast of a leader. A missing orientation is 0.

    Raise FollowMobilityException if the message is not the broadcast of a leader.
    """
    try:
        payload = json.loads(message.removeprefix(LEADER_PREFIX))
        identifier, position = payload["id"], payload["position"]
        orientation = payload.get("orientation", 0.0)
    except (ValueError, TypeError, KeyError, AttributeError) as error:
        raise FollowMobilityException(f"expected the message of a leader, got {message!r}") from error
    if type(identifier) is not int:
        raise FollowMobilityException(f"the id of a leader must be an integer, got {message!r}")
    return LeaderState(
        identifier,
        checked_point("the position of a leader", position, FollowMobilityException),
        checked_orientation(orientation),
    )


def encode_follower(identifier: int) -> str:
    """Return the answer of a follower."""
    return f"{FOLLOWER_PREFIX}{identifier}"


def decode_follower(message: str) -> int:
    """Return the id of the follower that sent the message. FollowMobilityException if none did."""
    try:
        return int(message.removeprefix(FOLLOWER_PREFIX))
    except ValueError:
        raise FollowMobilityException(f"expected the message of a follower, got {message!r}") from None


def checked_orientation(orientation: object) -> float:
    """Return an angle in degrees as a float; FollowMobilityException if it is not finite."""
    return checked_number("an orientation", orientation, unit="degrees", error=FollowMobilityException)
