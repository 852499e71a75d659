"""Messages and timers that reach a protocol's provider."""

import json
from random import Random

import pytest

from gradysim.protocol.messages.communication import CommunicationCommandType
from gradysim.protocol.plugin.raft import FailureConfig
from gradysim.protocol.plugin.raft.membership_view import MembershipView
from gradysim.protocol.plugin.raft.raft_message import RequestVote, RequestVoteResponse
from gradysim.protocol.plugin.raft.transport import Transport
from python.protocol.plugin.raft.bare_provider import BareProvider

REPLY = RequestVoteResponse(1, True, 3)


@pytest.fixture
def provider():
    return BareProvider()


@pytest.fixture
def membership():
    return MembershipView(3, FailureConfig(), lambda: 7.0)


@pytest.fixture
def transport(provider, membership):
    return Transport(provider, membership)


def sent_by(provider):
    """Return the messages as dictionaries, each with its destination."""
    return [
        (json.loads(command.message.removeprefix("__RAFT__:")), command.destination)
        for command in provider.sent
    ]


def test_a_broadcast_is_sent_at_once(transport, provider):
    transport.broadcast(RequestVote(1, 3))
    transport.broadcast_text("hello")
    assert {command.command_type for command in provider.sent} == {CommunicationCommandType.BROADCAST}
    assert provider.sent[1].message == "__RAFT__:hello"


def test_a_reply_waits_for_its_timer(transport, provider):
    transport.reply(REPLY, 0, 0.5)
    before = list(provider.sent)
    transport.send_next_reply()
    assert (before, provider.timers) == ([], {"__RAFT__:reply": 7.5})
    assert [destination for _, destination in sent_by(provider)] == [0]


def test_replies_leave_in_order_one_for_each_timer(transport, provider):
    for destination in (2, 1):
        transport.reply(REPLY, destination, 0.5)
    transport.pending_timers.clear()
    pending = []
    for _ in range(3):
        transport.send_next_reply()
        pending.append(transport.pending_timers.copy())
        transport.pending_timers.clear()
    assert [destination for _, destination in sent_by(provider)] == [2, 1]
    assert pending == [{"reply"}, set(), set()]


def test_dropped_replies_are_not_sent(transport, provider):
    transport.reply(REPLY, 2, 0.5)
    transport.drop_replies()
    transport.send_next_reply()
    assert (provider.sent, provider.timers) == ([], {})


def test_messages_name_the_known_members_until_they_are_set(transport, provider, membership):
    membership.learn([7])
    transport.broadcast(RequestVote(1, 3))
    membership.fix([7])
    transport.broadcast(RequestVote(1, 3))
    assert [message.get("known_nodes") for message, _ in sent_by(provider)] == [[3, 7], None]


def test_messages_name_the_cluster(transport, provider, membership):
    membership.cluster_id = 6
    transport.broadcast(RequestVote(1, 3))
    assert sent_by(provider)[0][0]["cluster_id"] == 6


def test_restarting_a_timer_cancels_it(transport, provider, monkeypatch):
    canceled = []
    monkeypatch.setattr(provider, "cancel_timer", canceled.append)
    transport.cancel_timer("heartbeat")
    transport.restart_timer("heartbeat", 0.1)
    transport.restart_timer("heartbeat", 0.5)
    assert (canceled, transport.pending_timers) == (["__RAFT__:heartbeat"], {"heartbeat"})
    assert provider.timers == {"__RAFT__:heartbeat": 7.5}


def test_timers_of_the_protocol_are_not_cancelled(transport, provider):
    provider.timers["heartbeat"] = 9.0
    transport.restart_timer("heartbeat", 0.5)
    transport.cancel_timer("heartbeat")
    assert provider.timers == {"heartbeat": 9.0}


def test_the_stream_of_the_provider_is_used(provider, membership):
    provider.random = Random(5)
    assert Transport(provider, membership).random is provider.random


def test_without_a_stream_each_node_has_its_own_and_always_the_same(membership):
    first, again, other = (
        Transport(BareProvider(number), membership).random.random() for number in (1, 1, 2)
    )
    assert first == again != other
