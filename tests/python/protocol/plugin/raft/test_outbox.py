import json
from random import Random

import pytest

from gradysim.protocol.plugin.raft import RaftConfig
from gradysim.protocol.plugin.raft.cluster import Cluster
from gradysim.protocol.plugin.raft.membership import Membership
from gradysim.protocol.plugin.raft.node_timers import NodeTimers
from gradysim.protocol.plugin.raft.outbox import Outbox
from gradysim.protocol.plugin.raft.raft_message import RequestVote, RequestVoteResponse


class Recorder:
    """An environment that keeps what it is given."""

    node_id = 4

    def __init__(self):
        self.random = Random(1)
        self.sent = []
        self.timers = []

    def send(self, message, destination):
        self.sent.append((json.loads(message), destination))

    def set_timer(self, name, delay_s):
        self.timers.append((name, delay_s))

    def cancel_timer(self, name):
        self.timers.append((name, "cancelled"))


@pytest.fixture
def environment():
    return Recorder()


@pytest.fixture
def membership():
    return Membership(4)


@pytest.fixture
def cluster():
    return Cluster()


@pytest.fixture
def outbox(environment, membership, cluster):
    return Outbox(environment, membership, cluster, NodeTimers(RaftConfig(), environment))


def test_a_broadcast_goes_at_once_to_everybody(outbox, environment):
    outbox.broadcast(RequestVote(1, 4))
    assert environment.sent[0][1] is None


def test_a_reply_waits_for_its_timer(outbox, environment):
    outbox.reply(RequestVoteResponse(1, True, 4), 2)
    before = list(environment.sent)
    outbox.send_reply()
    assert (before, [destination for _, destination in environment.sent]) == ([], [2])


def test_replies_go_in_order_one_for_each_timer(outbox, environment):
    for destination in (2, 3):
        outbox.reply(RequestVoteResponse(1, True, 4), destination)
    for _ in range(3):
        outbox.send_reply()
    assert [destination for _, destination in environment.sent] == [2, 3]
    assert [name for name, _ in environment.timers] == ["reply", "reply"]


def test_replies_are_spread_over_5_ms(outbox, environment):
    for _ in range(200):
        outbox.reply(RequestVoteResponse(1, True, 4), 2)
    delays_s = [delay_s for _, delay_s in environment.timers]
    assert 0 <= min(delays_s) < 0.0005 < 0.0045 < max(delays_s) <= 0.005


def test_cleared_replies_are_not_sent(outbox, environment):
    outbox.reply(RequestVoteResponse(1, True, 4), 2)
    outbox.clear()
    outbox.send_reply()
    assert (environment.sent, environment.timers[-1]) == ([], ("reply", "cancelled"))


def test_messages_name_the_members_known_until_they_are_set(outbox, environment, membership):
    membership.learn([7])
    outbox.broadcast(RequestVote(1, 4))
    membership.fix([7])
    outbox.broadcast(RequestVote(1, 4))
    assert [message.get("known_nodes") for message, _ in environment.sent] == [[4, 7], None]


def test_messages_name_the_cluster(outbox, environment, cluster):
    cluster.cluster_id = 6
    outbox.broadcast(RequestVote(1, 4))
    assert environment.sent[0][0]["cluster_id"] == 6
