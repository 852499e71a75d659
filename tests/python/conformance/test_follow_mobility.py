"""Leaders and followers behave alike in both modes.

Telemetry drives the mission of a leader, so it flies alike in both modes. A follower gets a new target with
each broadcast of its leader, at random times between two updates of the prototype's positions. Its target is
the same in both modes. Its position differs by at most two steps: in the prototype it flies to the old target
for up to one step too long, and is up to one step behind.

No timer here is due at the time of an update: docs/decisions/0015-order-within-one-instant.md explains this.
"""

from typing import ClassVar

import pytest
from perfect_channel import Case
from watched_run import UPDATE_S, Trace, assert_same, trace_case

from gradysim.protocol.messages.mobility import SetSpeedMobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.plugin.follow_mobility import (
    MobilityFollowerConfiguration,
    MobilityFollowerPlugin,
    MobilityLeaderConfiguration,
    MobilityLeaderPlugin,
)
from gradysim.protocol.plugin.mission_mobility import (
    LoopMission,
    MissionMobilityConfiguration,
    MissionMobilityPlugin,
)
from python.quiet_protocol import Quiet

SPEED_MPS = 9.1
TOLERANCE_M = 2 * SPEED_MPS * UPDATE_S
FOLLOWERS = {2, 3, 4}


def case(duration_s: float = 12.0) -> Case:
    return Case(
        [(7.1 * node, 3.3 * node, 1.9 * node) for node in range(5)],
        range_m=1000.0,
        telemetry_interval_s=UPDATE_S,
        duration_s=duration_s,
        speed_mps=SPEED_MPS,
    )


class Leader(Quiet):
    """Flies back and forth; the first one is silent for a while, and turns around."""

    jitter: ClassVar[float] = 0.5

    def initialize(self) -> None:
        self.leader = MobilityLeaderPlugin(
            self,
            MobilityLeaderConfiguration(
                broadcast_interval=0.10703,
                follower_timeout=0.83,
                initial_orientation=30.0,
                broadcast_jitter=self.jitter,
            ),
        )
        self.mission = MissionMobilityPlugin(
            self,
            MissionMobilityConfiguration(speed=4.3, loop_mission=LoopMission.REVERSE, tolerance=0.517),
        )
        self.mission.start_mission([(10.3, 20.9, 5.7), (-13.1, 2.3, 9.9)])
        self.provider.schedule_timer("turn", 3.003)
        if self.provider.get_id() == 0:
            self.provider.schedule_timer("silence", 5.003)
            self.provider.schedule_timer("speech", 8.503)

    def handle_timer(self, timer: str) -> None:
        if timer == "turn":
            self.leader.set_orientation(self.leader.orientation + 37.0)
            self.provider.schedule_timer("turn", self.provider.current_time() + 1.7)
        else:
            self.leader.is_broadcasting = timer == "speech"

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        self.provider.tracked_variables["followers"] = sorted(self.leader.followers)


class Follower(Quiet):
    """Keeps its position; logs its leader."""

    turns: ClassVar[bool] = True
    chooses: ClassVar[bool] = False

    def initialize(self) -> None:
        self.follower = MobilityFollowerPlugin(
            self,
            MobilityFollowerConfiguration(
                scanning_interval=0.4137,
                leader_timeout=1.3,
                auto_follow=not self.chooses,
                follow_orientation=self.turns,
            ),
        )
        self.follower.set_relative_position((2.0, -3.1 * self.provider.get_id(), 1.5))
        self.provider.send_mobility_command(SetSpeedMobilityCommand(SPEED_MPS))
        self.provider.tracked_variables["followed"] = []

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        if self.chooses and self.follower.available_leaders:
            self.follower.follow_leader(max(self.follower.available_leaders))
        followed = self.provider.tracked_variables["followed"]
        seen = (self.follower.current_leader, self.follower.current_leader_orientation)
        if not followed or followed[-1] != seen:
            followed.append(seen)


def fly(follower: type[Follower], leader: type[Leader] = Leader) -> Trace:
    """Check that both modes agree; return the trace."""
    integrated, prototype = (
        trace_case(mode, case(), leader, leader, follower) for mode in ("integrated", "prototype")
    )
    assert_same(integrated, prototype, dict.fromkeys(FOLLOWERS, TOLERANCE_M))
    return integrated


@pytest.mark.parametrize("turns", [True, False], ids=["with orientation", "without orientation"])
@pytest.mark.parametrize("chooses", [True, False], ids=["chosen leader", "leader taken"])
def test_leaders_and_followers(turns: bool, chooses: bool) -> None:
    trace = fly(type("Follower", (Follower,), {"turns": turns, "chooses": chooses}))
    for node in FOLLOWERS:
        assert trace.names(node).count("send_mobility_command") > 50
    assert any("[2, 3, 4]" in tracked for tracked in trace.tracked)


def test_leaders_that_send_in_lock_step() -> None:
    fly(Follower, type("Leader", (Leader,), {"jitter": 0.0}))


def test_a_silent_leader_is_left_for_the_other_one() -> None:
    *_, follower = fly(Follower).tracked
    assert "(0, " in follower
    assert "(1, " in follower
