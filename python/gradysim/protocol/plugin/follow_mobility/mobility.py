"""What leaders and followers say to each other: the tags of their timers and messages, and the formats.

A leader broadcasts `LEADER_TAG:{"id": 0, "position": [x, y, z], "orientation": degrees}`; a follower answers
with `FOLLOWER_TAG:id`, to its leader alone.
"""

import json
import math
from typing import NamedTuple

from gradysim.protocol.checked_values import checked_number, checked_point
from gradysim.protocol.plugin.follow_mobility.exception import FollowMobilityException
from gradysim.protocol.position import Position

LEADER_TAG = "FollowMobilityPlugin__leader"
FOLLOWER_TAG = "FollowMobilityPlugin__follower"
BROADCAST_TIMER_TAG = "FollowMobilityPlugin__leader_broadcast_timer"
FOLLOWER_TIMER_TAG = "FollowMobilityPlugin__follower_timer"

LEADER_PREFIX = f"{LEADER_TAG}:"
FOLLOWER_PREFIX = f"{FOLLOWER_TAG}:"


class LeaderState(NamedTuple):
    """What a leader says of itself: its id, where it is (m) and which way it looks (degrees)."""

    id: int
    position: Position
    orientation: float


def encode_leader(state: LeaderState) -> str:
    """Return the message of a leader."""
    return LEADER_PREFIX + json.dumps(state._asdict())


def decode_leader(message: str) -> LeaderState:
    """Return what the message of a leader says; a missing orientation is 0.

    Raises:
        FollowMobilityException: The message is not one of a leader.
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
    """Return the message of a follower."""
    return f"{FOLLOWER_PREFIX}{identifier}"


def decode_follower(message: str) -> int:
    """Return the id of the follower that the message is from.

    Raises:
        FollowMobilityException: The message is not one of a follower.
    """
    try:
        return int(message.removeprefix(FOLLOWER_PREFIX))
    except ValueError:
        raise FollowMobilityException(f"expected the message of a follower, got {message!r}") from None


def checked_orientation(orientation: object) -> float:
    """Return an angle in degrees as a number; FollowMobilityException if it is not finite."""
    return checked_number(
        "an orientation",
        orientation,
        math.isfinite,
        "a finite number of degrees",
        FollowMobilityException,
    )
