"""What a provider offers, with the prefix of the consensus."""

from random import Random

import pytest

from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.protocol.plugin.raft.provider_environment import ProviderEnvironment
from python.protocol.plugin.raft.bare_provider import BareProvider


@pytest.fixture
def provider():
    return BareProvider()


@pytest.fixture
def environment(provider):
    return ProviderEnvironment(provider)


def test_without_a_destination_a_message_is_a_broadcast(environment, provider):
    environment.send("hello", None)
    environment.send("hello", 0)
    assert provider.sent == [
        BroadcastMessageCommand("__RAFT__:hello"),
        SendMessageCommand("__RAFT__:hello", 0),
    ]


def test_delays_become_times(environment, provider):
    environment.set_timer("reply", 0.5)
    assert provider.timers == {"__RAFT__:reply": 7.5}


def test_timers_are_cancelled_by_the_name_that_they_were_set_by(environment, provider):
    provider.timers["reply"] = 9.0  # of the protocol
    environment.set_timer("reply", 0.5)
    environment.cancel_timer("reply")
    assert provider.timers == {"reply": 9.0}


def test_the_stream_of_the_provider_is_used(provider):
    provider.random = Random(5)
    assert ProviderEnvironment(provider).random is provider.random


def test_without_one_each_node_has_its_own_and_always_the_same():
    first, again, other = (ProviderEnvironment(BareProvider(number)).random.random() for number in (1, 1, 2))
    assert first == again != other
