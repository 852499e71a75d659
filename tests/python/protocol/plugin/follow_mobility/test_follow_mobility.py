"""Leaders and followers together."""

import importlib

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import gradysim.integrated.run
import gradysim.prototype.run
from gradysim.protocol.plugin import follow_mobility
from gradysim.protocol.position import rotate_position_2d
from gradysim.simulator.simulation import SimulationConfiguration

FLIGHT = """
import json
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand
from gradysim.protocol.plugin.follow_mobility import (
    MobilityFollowerConfiguration, MobilityFollowerPlugin, MobilityLeaderConfiguration, MobilityLeaderPlugin
)

class Leader(Quiet):
    jitter = 0.5
    orientation = 90.0
    target = (40.0, 30.0, 20.0)

    def initialize(self):
        self.heard = {}
        self.leader = MobilityLeaderPlugin(
            self,
            MobilityLeaderConfiguration(
                0.1, initial_orientation=self.orientation, broadcast_jitter=self.jitter
            ),
        )
        x, y, z = self.target
        place = (x, y + 5 * self.provider.get_id(), z)
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(*place))

    def handle_packet(self, message):
        sender = json.loads(message.partition(":")[2])["id"]
        self.heard[sender] = self.heard.get(sender, 0) + 1

    def finish(self):
        self.provider.tracked_variables.update(
            heard=self.heard, followers=sorted(self.leader.followers)
        )

class Follower(Quiet):
    relative = (0.0, 10.0, -2.0)

    def initialize(self):
        self.follower = MobilityFollowerPlugin(self)
        self.follower.set_relative_position(self.relative)

    def finish(self):
        self.provider.tracked_variables["leader"] = self.follower.current_leader

class Late(Follower):
    def initialize(self):
        self.provider.schedule_timer("late", 3)

    def handle_timer(self, timer):
        super().initialize()
"""

GROUP = [
    "sim-time-limit = 15s",
    '*.leader.protocol.class = "protocols.py:Leader"',
    "*.followers.count = 3",
    '*.followers[*].protocol.class = "protocols.py:Follower"',
    "*.followers[*].mobility.lineStepX = 3m",
]


BOTH = "LEADER_TAG FOLLOWER_TAG"
LEADER = f"MobilityLeaderConfiguration MobilityLeaderPlugin {BOTH} BROADCAST_TIMER_TAG"
FOLLOWER = (
    f"MobilityFollowerConfiguration MobilityFollowerPlugin FollowMobilityException {BOTH} FOLLOWER_TIMER_TAG"
)


@pytest.mark.parametrize(
    ("module", "names"),
    [
        ("follow_mobility", f"{LEADER} {FOLLOWER}"),
        ("follow_mobility.leader", LEADER),
        ("follow_mobility.follower", FOLLOWER),
        ("follow_mobility.mobility", f"{BOTH} BROADCAST_TIMER_TAG FOLLOWER_TIMER_TAG"),
    ],
)
def test_everything_is_where_it_was_published(module, names):
    found = importlib.import_module(f"gradysim.protocol.plugin.{module}")
    for name in names.split():
        assert getattr(found, name) is getattr(follow_mobility, name)


@pytest.mark.parametrize("kind", ["Follower", "Late"])
def test_followers_take_their_place_beside_the_leader(make_scenario, run_mode, kind):
    group = [line.replace("Follower", kind) for line in GROUP]
    leader, *followers = run_mode(make_scenario(FLIGHT, *group))
    assert leader.position == pytest.approx((40, 30, 20))
    assert leader.tracked_variables["followers"] == [1, 2, 3]
    for follower in followers:
        assert follower.tracked_variables["leader"] == 0
        assert follower.position == pytest.approx((30, 30, 18))


FIRST_BROADCAST = """
import json
from gradysim.protocol.plugin.follow_mobility import MobilityLeaderConfiguration, MobilityLeaderPlugin

class Leader(Quiet):
    def initialize(self):
        MobilityLeaderPlugin(self, MobilityLeaderConfiguration(broadcast_jitter=0))

class Hears(Quiet):
    def handle_packet(self, message):
        position = json.loads(message.partition(":")[2])["position"]
        first = (self.provider.current_time(), position)
        self.provider.tracked_variables.setdefault("first", first)
"""


@pytest.mark.parametrize("mode", [gradysim.integrated.run, gradysim.prototype.run])
def test_the_first_broadcast_does_not_wait_for_telemetry(make_scenario, mode):
    scenario = make_scenario(
        FIRST_BROADCAST,
        "sim-time-limit = 0.5s",
        '*.leader.protocol.class = "protocols.py:Leader"',
        "*.leader.mobility.initialX = 4m",
        "*.leader.mobility.telemetryInterval = 1s",
        "*.others.count = 1",
        '*.others[*].protocol.class = "protocols.py:Hears"',
    )
    time_s, position = mode.run(scenario).nodes[1].tracked_variables["first"]
    assert time_s == pytest.approx(0.02, abs=0.001)
    assert position == [4, 0, 0]


coordinates = st.floats(-50, 50)
points = st.tuples(coordinates, coordinates, coordinates)


def test_whatever_the_place_they_converge_to_it(make_scenario, build_simulation):
    scenario = make_scenario(FLIGHT, *GROUP)
    leader_class, follower_class = (node.protocol for node in scenario.nodes[:2])

    @given(target=points, relative=points, orientation=st.floats(-360, 360))
    @settings(max_examples=10)
    def law(target, relative, orientation):
        simulator = build_simulation(
            SimulationConfiguration(duration=30, seed=1, execution_logging=False),
            type("Leader", (leader_class,), {"target": target, "orientation": orientation}),
            type("Follower", (follower_class,), {"relative": relative}),
        )
        simulator.start_simulation()
        place = rotate_position_2d(relative, orientation)
        assert simulator.get_node(0).position == pytest.approx(target)
        assert simulator.get_node(1).position == pytest.approx(
            [a + b for a, b in zip(target, place, strict=True)], abs=1e-6
        )

    law()


CROWD = [
    "sim-time-limit = 10s",
    "*.leaders.count = 5",
    '*.leaders[*].protocol.class = "protocols.py:Leader"',
    "*.leaders[*].mobility.lineStepX = 5m",
    "*.followers.count = 3",
    '*.followers[*].protocol.class = "protocols.py:Follower"',
    "*.followers[*].mobility.lineStartY = 5m",
]
REAL_CHANNEL = '*.radioMedium.typename = "Ieee80211ScalarRadioMedium"'


def test_on_a_real_channel_leaders_hear_each_other_and_have_followers(make_scenario, run_integrated):
    nodes = run_integrated(make_scenario(FLIGHT, REAL_CHANNEL, *CROWD))
    for node in nodes[:5]:
        heard = node.tracked_variables["heard"]
        assert len(heard) == 4
        assert min(heard.values()) > 90  # out of 98 or 99
    assert nodes[0].tracked_variables["followers"] == [5, 6, 7]


def test_in_lock_step_none_of_them_is_heard(make_scenario, run_integrated):
    lock_step = "*.leaders[*].protocol.jitter = 0.0"
    nodes = run_integrated(make_scenario(FLIGHT, REAL_CHANNEL, lock_step, *CROWD))
    assert [node.tracked_variables["heard"] for node in nodes[:5]] == [{}] * 5
    assert [node.tracked_variables["leader"] for node in nodes[5:]] == [None] * 3
