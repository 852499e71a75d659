from random import Random

import pytest

from gradysim.protocol.plugin.raft import RaftConfig
from gradysim.protocol.plugin.raft.node_timers import NodeTimers


class Recorder:
    """An environment that keeps the timers that it is given."""

    def __init__(self):
        self.random = Random(1)
        self.delays_s = []
        self.cancelled = []

    def set_timer(self, name, delay_s):
        self.delays_s.append(delay_s)

    def cancel_timer(self, name):
        self.cancelled.append(name)


@pytest.fixture
def environment():
    return Recorder()


@pytest.mark.parametrize(
    ("restart", "low_s", "high_s"),
    [
        ("restart_election", 0.15, 0.3),
        ("restart_heartbeat", 0.045, 0.055),
        ("restart_discovery_round", 0.03, 0.0367),
        ("add_reply", 0.0, 0.005),
    ],
)
def test_durations_are_drawn_from_all_of_their_range(environment, restart, low_s, high_s):
    timers = NodeTimers(RaftConfig(), environment)
    for _ in range(300):
        getattr(timers, restart)()
    tenth_s = (high_s - low_s) / 10
    assert low_s <= min(environment.delays_s) < low_s + tenth_s
    assert high_s - tenth_s < max(environment.delays_s) <= high_s


def test_restarting_a_timer_cancels_it(environment):
    timers = NodeTimers(RaftConfig(), environment)
    timers.restart_election()
    timers.restart_election()
    assert (environment.cancelled, timers.pending) == (["election_timeout"], {"election_timeout"})


def test_cancelling_what_is_not_set_does_nothing(environment):
    NodeTimers(RaftConfig(), environment).cancel("heartbeat")
    assert environment.cancelled == []
