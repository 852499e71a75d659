"""Plugins for followers that keep a position relative to a leader."""

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
    FollowMobilityException,
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
