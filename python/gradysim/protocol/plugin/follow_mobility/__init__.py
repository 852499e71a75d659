"""Followers that keep their place beside a leader, wherever it goes."""

from gradysim.protocol.plugin.follow_mobility.exception import FollowMobilityException
from gradysim.protocol.plugin.follow_mobility.follower import (
    MobilityFollowerConfiguration,
    MobilityFollowerPlugin,
)
from gradysim.protocol.plugin.follow_mobility.leader import MobilityLeaderConfiguration, MobilityLeaderPlugin
from gradysim.protocol.plugin.follow_mobility.mobility import (
    BROADCAST_TIMER_TAG,
    FOLLOWER_TAG,
    FOLLOWER_TIMER_TAG,
    LEADER_TAG,
)

__all__ = [
    "BROADCAST_TIMER_TAG",
    "FOLLOWER_TAG",
    "FOLLOWER_TIMER_TAG",
    "LEADER_TAG",
    "FollowMobilityException",
    "MobilityFollowerConfiguration",
    "MobilityFollowerPlugin",
    "MobilityLeaderConfiguration",
    "MobilityLeaderPlugin",
]
