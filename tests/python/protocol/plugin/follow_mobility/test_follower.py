import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.messages.communication import CommunicationCommandType
from gradysim.protocol.plugin.follow_mobility.follower import (
    FOLLOWER_TAG,
    FOLLOWER_TIMER_TAG,
    LEADER_TAG,
    FollowMobilityException,
    MobilityFollowerConfiguration,
    MobilityFollowerPlugin,
)
from gradysim.protocol.plugin.follow_mobility.mobility import LeaderState, encode_leader


def follow(protocol, **configuration):
    return MobilityFollowerPlugin(protocol, MobilityFollowerConfiguration(**configuration))


def hear(protocol, leader=3, position=(10.0, 20.0, 30.0), orientation=0.0):
    protocol.handle_packet(encode_leader(LeaderState(leader, position, orientation)))


def scan(protocol, time):
    protocol.provider.pass_time(protocol, time)


def following(protocol, leader=3, **configuration):
    """Return a follower of that leader, whose broadcast it has received once, at time 0."""
    plugin = follow(protocol, **configuration)
    hear(protocol, leader)
    plugin.follow_leader(leader)
    return plugin


def test_the_defaults_are_the_published_ones():
    assert MobilityFollowerConfiguration() == MobilityFollowerConfiguration(0.5, 2, True, True)


def test_a_new_follower_follows_nobody(protocol):
    plugin = follow(protocol)
    assert (plugin.available_leaders, plugin.current_leader, plugin.relative_position) == (
        set(),
        None,
        (0, 0, 0),
    )
    assert (plugin.current_leader_position, plugin.current_leader_orientation) == (None, None)


def test_created_late_it_looks_around_from_then(protocol):
    protocol.provider.now = 100.0
    follow(protocol, scanning_interval=1)
    assert protocol.provider.timers == [(101, FOLLOWER_TIMER_TAG)]


def test_who_is_heard_is_available(protocol):
    plugin = follow(protocol)
    hear(protocol, 3)
    hear(protocol, 4)
    assert (plugin.available_leaders, plugin.current_leader) == ({3, 4}, None)


def test_a_look_chooses_the_leader_with_the_smallest_id(protocol):
    plugin = follow(protocol)
    for leader in (9, 8, 20):
        hear(protocol, leader)
    scan(protocol, 0.5)
    assert plugin.current_leader == 8


def test_a_look_keeps_the_leader_that_it_has(protocol):
    plugin = following(protocol, 9)
    hear(protocol, 8)
    scan(protocol, 0.5)
    assert plugin.current_leader == 9


def test_without_auto_follow_it_waits_to_be_told(protocol):
    plugin = follow(protocol, auto_follow=False)
    hear(protocol)
    scan(protocol, 1)
    hear(protocol)
    assert (plugin.available_leaders, plugin.current_leader) == ({3}, None)
    assert (protocol.provider.targets, protocol.provider.sent) == ([], [])
    plugin.follow_leader(3)
    hear(protocol)
    assert protocol.provider.targets == [(10, 20, 30)]


def test_hearing_the_leader_moves_and_answers(make_protocol):
    protocol = make_protocol(node_id=5)
    plugin = following(protocol)
    plugin.set_relative_position((1, 2, 3))
    hear(protocol)
    assert protocol.provider.targets == [(11, 22, 33)]
    (command,) = protocol.provider.sent
    assert (command.command_type, command.message, command.destination) == (
        CommunicationCommandType.SEND,
        f"{FOLLOWER_TAG}:5",
        3,
    )


def test_hearing_the_leader_tells_where_it_is(protocol):
    plugin = following(protocol)
    assert plugin.current_leader_position is None
    hear(protocol, orientation=30)
    assert (plugin.current_leader_position, plugin.current_leader_orientation) == ((10, 20, 30), 30)


def test_hearing_another_leader_does_nothing(protocol):
    following(protocol, 3)
    hear(protocol, 4)
    assert (protocol.provider.targets, protocol.provider.sent) == ([], [])


@pytest.mark.parametrize(("turns", "target"), [(True, (10, 21, 35)), (False, (11, 20, 35))])
def test_the_relative_position_turns_with_the_leader(protocol, turns, target):
    plugin = following(protocol, follow_orientation=turns)
    plugin.set_relative_position((1, 0, 5))
    hear(protocol, orientation=90)
    assert protocol.provider.targets == [pytest.approx(target)]


coordinates = st.floats(-1e3, 1e3)
points = st.tuples(coordinates, coordinates, coordinates)


@given(points, points, st.floats(-1e3, 1e3))
def test_the_distance_to_the_leader_does_not_depend_on_its_orientation(
    make_protocol, leader, relative, angle
):
    protocol = make_protocol()
    plugin = following(protocol)
    plugin.set_relative_position(relative)
    hear(protocol, position=leader, orientation=angle)
    (target,) = protocol.provider.targets
    assert math.dist(target, leader) == pytest.approx(math.hypot(*relative), abs=1e-9)
    assert target[2] == leader[2] + relative[2]


def test_changing_the_leader_forgets_where_the_old_one_was(protocol):
    plugin = following(protocol, 3)
    hear(protocol, 3)
    hear(protocol, 4)
    plugin.follow_leader(4)
    assert (plugin.current_leader, plugin.current_leader_position) == (4, None)


def test_following_the_leader_that_it_follows_changes_nothing(protocol):
    plugin = following(protocol, 3)
    hear(protocol, 3)
    plugin.follow_leader(3)
    assert plugin.current_leader_position == (10, 20, 30)


def test_a_leader_that_is_not_there_cannot_be_followed(protocol):
    plugin = follow(protocol)
    with pytest.raises(FollowMobilityException, match="9"):
        plugin.follow_leader(9)
    hear(protocol, 4)
    hear(protocol, 3)
    with pytest.raises(FollowMobilityException, match=r"leader 9 .*: 3, 4"):
        plugin.follow_leader(9)


def test_a_leader_not_heard_for_the_timeout_is_gone(protocol):
    plugin = following(protocol)
    hear(protocol)
    scan(protocol, 1.5)
    assert (plugin.available_leaders, plugin.current_leader) == ({3}, 3)
    scan(protocol, 2)
    assert (plugin.available_leaders, plugin.current_leader) == (set(), None)
    assert (plugin.current_leader_position, plugin.current_leader_orientation) == (None, None)


def test_a_lost_leader_is_replaced(protocol):
    plugin = following(protocol, 3)
    scan(protocol, 1)
    hear(protocol, 4)
    scan(protocol, 2)
    assert plugin.current_leader == 4


@given(st.lists(st.integers(0, 100), max_size=20), st.integers(1, 20), st.integers(1, 30))
def test_leaders_are_those_heard_within_the_timeout_before_the_look(
    make_protocol, hearings, interval, timeout
):
    protocol = make_protocol()
    plugin = follow(protocol, scanning_interval=interval, leader_timeout=timeout)
    moments = sorted(time + 0.5 for time in hearings)  # between two checks, which come at integer seconds
    last = -math.inf
    for time in moments:
        scan(protocol, time)
        hear(protocol)
        last = time
        assert plugin.available_leaders == {3}
    end = math.floor(max(last, 0)) + interval * math.ceil(timeout / interval + 1)
    for time in range(math.ceil(max(last, 0)), end + 1):
        scan(protocol, time)
        latest_look = time // interval * interval
        assert plugin.available_leaders == ({3} if latest_look - last < timeout else set())


def test_its_own_events_do_not_reach_the_protocol(protocol):
    following(protocol)
    hear(protocol, 4)
    scan(protocol, 5)
    assert protocol.calls == []


def test_all_others_do(protocol):
    following(protocol)
    protocol.handle_packet(f"{FOLLOWER_TAG}:3")
    protocol.handle_timer("mine")
    assert [argument for _, argument in protocol.calls] == [f"{FOLLOWER_TAG}:3", "mine"]


def test_a_malformed_broadcast_is_refused(protocol):
    follow(protocol)
    with pytest.raises(FollowMobilityException, match=f"{LEADER_TAG}:nonsense"):
        protocol.handle_packet(f"{LEADER_TAG}:nonsense")


@pytest.mark.parametrize("position", [(1, 2), (1, 2, math.nan), None])
def test_a_wrong_relative_position_is_refused(protocol, position):
    with pytest.raises(FollowMobilityException, match="position"):
        follow(protocol).set_relative_position(position)


@pytest.mark.parametrize("name", ["scanning_interval", "leader_timeout"])
@pytest.mark.parametrize("value", [0, -1, math.nan, "1"])
def test_a_wrong_configuration_is_refused(protocol, name, value):
    with pytest.raises(FollowMobilityException, match=f"{name} .*{value!r}"):
        follow(protocol, **{name: value})


def test_a_leader_may_be_waited_for_for_ever_but_not_the_next_look(protocol):
    follow(protocol, leader_timeout=math.inf)
    with pytest.raises(FollowMobilityException, match=r"^scanning_interval "):
        follow(protocol, scanning_interval=math.inf)
