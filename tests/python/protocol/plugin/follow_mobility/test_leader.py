import json
import logging
import math
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.messages.communication import CommunicationCommandType
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.plugin.follow_mobility.leader import (
    BROADCAST_TIMER_TAG,
    FOLLOWER_TAG,
    LEADER_TAG,
    BroadcastClock,
    FollowMobilityException,
    MobilityLeaderConfiguration,
    MobilityLeaderPlugin,
)

POSITION = (1.0, 2.0, 3.0)


def lead(protocol, **configuration):
    """Return a leader with telemetry."""
    plugin = MobilityLeaderPlugin(protocol, MobilityLeaderConfiguration(**configuration))
    protocol.handle_telemetry(Telemetry(POSITION))
    protocol.calls.clear()
    return plugin


def payloads(protocol):
    return [json.loads(command.message.removeprefix(f"{LEADER_TAG}:")) for command in protocol.provider.sent]


def answer(protocol, follower, time):
    protocol.provider.pass_time(protocol, time)
    protocol.handle_packet(f"{FOLLOWER_TAG}:{follower}")


def test_the_defaults_are_the_published_ones_and_a_jitter():
    assert MobilityLeaderConfiguration() == MobilityLeaderConfiguration(0.02, 5, 0.0, 0.5)


def test_a_new_leader_broadcasts_and_has_no_followers(protocol):
    plugin = MobilityLeaderPlugin(protocol)
    assert (plugin.is_broadcasting, plugin.followers, plugin.orientation) == (True, set(), 0)


def test_it_broadcasts_id_position_and_orientation(make_protocol):
    protocol = make_protocol(node_id=4)
    lead(protocol, initial_orientation=45)
    protocol.provider.pass_time(protocol, 0.03)
    assert payloads(protocol) == [{"id": 4, "position": list(POSITION), "orientation": 45}]
    (command,) = protocol.provider.sent
    assert (command.command_type, command.destination) == (CommunicationCommandType.BROADCAST, None)


def test_it_broadcasts_once_in_each_interval(protocol):
    lead(protocol, broadcast_interval=0.5)
    for number in range(1, 20):
        protocol.provider.pass_time(protocol, 0.5 * (number + 1) - 1e-9)
        assert len(protocol.provider.sent) == number


def test_siblings_do_not_broadcast_together(make_protocol):
    first = set()
    for node_id in range(20):
        protocol = make_protocol(node_id=node_id)
        lead(protocol)
        first.add(protocol.provider.timers[0][0])
    assert len(first) == 20


def test_without_jitter_broadcasts_are_periodic(protocol):
    lead(protocol, broadcast_interval=0.5, broadcast_jitter=0)
    assert protocol.provider.timers == [(0.5, BROADCAST_TIMER_TAG)]


def test_created_late_it_starts_from_then(protocol):
    protocol.provider.now = 100.0
    lead(protocol, broadcast_interval=1, broadcast_jitter=0)
    protocol.provider.pass_time(protocol, 102.5)
    assert len(protocol.provider.sent) == 2


def test_it_says_where_it_is_now(protocol):
    lead(protocol)
    protocol.handle_telemetry(Telemetry((9.0, 8.0, 7.0)))
    protocol.provider.pass_time(protocol, 0.03)
    assert payloads(protocol)[0]["position"] == [9, 8, 7]


def test_it_says_where_it_started_before_the_first_telemetry(protocol):
    protocol.provider.initial_position = POSITION
    MobilityLeaderPlugin(protocol)
    protocol.provider.pass_time(protocol, 0.03)
    assert payloads(protocol)[0]["position"] == list(POSITION)


def test_created_late_it_does_not_say_where_it_started(protocol):
    protocol.provider.initial_position = POSITION
    protocol.provider.now = 100.0
    MobilityLeaderPlugin(protocol)
    protocol.provider.pass_time(protocol, 101)
    assert protocol.provider.sent == []


def test_without_a_known_position_it_waits_for_telemetry(protocol, caplog):
    MobilityLeaderPlugin(protocol, MobilityLeaderConfiguration(broadcast_interval=0.5, broadcast_jitter=0))
    with caplog.at_level(logging.WARNING):
        protocol.provider.pass_time(protocol, 1)
    assert protocol.provider.sent == []
    assert [record.levelname for record in caplog.records] == ["WARNING"]
    protocol.handle_telemetry(Telemetry(POSITION))
    protocol.provider.pass_time(protocol, 1.5)
    assert len(protocol.provider.sent) == 1


def test_a_new_orientation_goes_out_with_the_next_broadcast(protocol):
    plugin = lead(protocol)
    plugin.set_orientation(-450)
    assert plugin.orientation == -450
    protocol.provider.pass_time(protocol, 0.03)
    assert payloads(protocol)[0]["orientation"] == -450


def test_broadcasts_can_be_left_out(protocol):
    plugin = lead(protocol, broadcast_interval=0.5, broadcast_jitter=0)
    plugin.is_broadcasting = False
    protocol.provider.pass_time(protocol, 1)
    assert protocol.provider.sent == []
    plugin.is_broadcasting = True
    protocol.provider.pass_time(protocol, 1.5)
    assert len(protocol.provider.sent) == 1


def test_who_answers_is_a_follower(protocol):
    plugin = lead(protocol)
    answer(protocol, 7, 0.1)
    answer(protocol, 9, 0.1)
    assert plugin.followers == {7, 9}


def test_the_set_of_followers_is_the_callers_own(protocol):
    plugin = lead(protocol)
    plugin.followers.add(5)
    assert plugin.followers == set()


def test_the_timeout_is_in_seconds(protocol):
    plugin = lead(protocol, follower_timeout=5)
    answer(protocol, 7, 1)
    protocol.provider.pass_time(protocol, 5.99)
    assert plugin.followers == {7}
    protocol.provider.pass_time(protocol, 6)
    assert plugin.followers == set()


@given(st.lists(st.tuples(st.integers(1, 4), st.integers(0, 300)), max_size=20), st.integers(1, 100))
def test_followers_are_those_who_answered_within_the_timeout(make_protocol, answers, timeout):
    protocol = make_protocol()
    plugin = lead(protocol, broadcast_interval=7, follower_timeout=timeout)
    last = {}
    for follower, time in sorted(answers, key=lambda answer: answer[1]):
        answer(protocol, follower, time)
        last[follower] = time
        assert plugin.followers == {id for id, heard in last.items() if time - heard < timeout}


def test_an_infinite_timeout_keeps_every_follower(protocol):
    plugin = lead(protocol, follower_timeout=math.inf, broadcast_interval=10)
    answer(protocol, 7, 1)
    protocol.provider.pass_time(protocol, 1e5)
    assert plugin.followers == {7}


def test_its_own_events_do_not_reach_the_protocol(protocol):
    lead(protocol)
    answer(protocol, 7, 1)
    assert protocol.calls == []


def test_all_others_do(protocol):
    lead(protocol)
    protocol.handle_packet(f"{LEADER_TAG}:of another leader")
    protocol.handle_timer("mine")
    assert [argument for _, argument in protocol.calls] == [f"{LEADER_TAG}:of another leader", "mine"]


def test_a_malformed_answer_is_refused(protocol):
    lead(protocol)
    with pytest.raises(FollowMobilityException, match=f"{FOLLOWER_TAG}:seven"):
        protocol.handle_packet(f"{FOLLOWER_TAG}:seven")


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("broadcast_interval", 0),
        ("broadcast_interval", math.inf),
        ("follower_timeout", 0),
        ("follower_timeout", math.nan),
        ("broadcast_jitter", 1.1),
        ("broadcast_jitter", -0.1),
        ("broadcast_jitter", "much"),
    ],
)
def test_a_wrong_configuration_is_refused(protocol, name, value):
    with pytest.raises(FollowMobilityException, match=f"{name} .*{value!r}"):
        lead(protocol, **{name: value})


def test_a_wrong_orientation_is_refused(protocol):
    plugin = lead(protocol)
    with pytest.raises(FollowMobilityException, match="orientation"):
        plugin.set_orientation(math.nan)
    with pytest.raises(FollowMobilityException, match="orientation"):
        lead(protocol, initial_orientation=None)


intervals = st.floats(1e-3, 1e3)
jitters = st.floats(0, 1)
starts = st.floats(0, 1e5)


def times(clock, start, count):
    """Return the first `count` times of the clock, each requested at the one before."""
    result = [clock.next(start)]
    while len(result) < count:
        result.append(clock.next(result[-1]))
    return result


@given(intervals, jitters, starts, st.randoms(use_true_random=False))
def test_each_interval_has_one_broadcast_in_its_first_part(interval, jitter, start, random):
    for number, time in enumerate(times(BroadcastClock(interval, jitter, start, random), start, 50), start=1):
        offset = (time - start) / interval - number
        assert -1e-6 <= offset <= jitter + 1e-6


@given(intervals, jitters, starts, st.randoms(use_true_random=False), st.floats(0, 1e5))
def test_no_broadcast_is_in_the_past(interval, jitter, start, random, late):
    clock = BroadcastClock(interval, jitter, start, random)
    clock.next(start)
    assert clock.next(start + late) >= start + late


def test_missed_intervals_are_skipped():
    clock = BroadcastClock(1.0, 0.0, 0.0, Random(0))
    assert [clock.next(0.0), clock.next(7.5), clock.next(8.0)] == [1.0, 8.0, 9.0]


def test_a_broadcast_at_the_end_of_its_interval_keeps_the_next_interval():
    class Latest(Random):
        def uniform(self, a, b):
            return b

    clock = BroadcastClock(546.97, 1.0, 0.0, Latest())
    assert times(clock, 0.0, 50) == pytest.approx([546.97 * (number + 1) for number in range(1, 51)])


def test_without_jitter_it_is_periodic():
    assert times(BroadcastClock(0.5, 0.0, 2.0, Random(0)), 2.0, 4) == [2.5, 3.0, 3.5, 4.0]


def test_the_mean_time_between_two_is_the_interval():
    result = times(BroadcastClock(0.5, 1.0, 0.0, Random(0)), 0.0, 1001)
    assert (result[-1] - result[0]) / 1000 == pytest.approx(0.5, abs=0.5 / 1000)


def test_two_clocks_with_other_streams_do_not_tick_together():
    one, other = (times(BroadcastClock(0.02, 0.5, 0.0, Random(seed)), 0.0, 100) for seed in (1, 2))
    assert set(one).isdisjoint(other)
