import math

import pytest

from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.simulator.extension.radio import Radio
from gradysim.simulator.handler.communication import (
    CommunicationException,
    CommunicationHandler,
    CommunicationMedium,
)
from gradysim.simulator.handler.timer import TimerHandler

POINTS = [(0, 0, 0), (30, 0, 0), (90, 0, 0)]


@pytest.fixture
def heard(simulation, idle):
    """Broadcast with a radio with these settings, from the first of POINTS; return the receptions."""

    def broadcast(**settings):
        calls = []

        class Listener(idle):
            def handle_packet(self, message):
                calls.append((self.provider.get_id(), self.provider.current_time()))

        running = simulation(POINTS, CommunicationHandler(), TimerHandler(), protocol=Listener)
        radio = Radio(running.get_node(0).protocol_encapsulator.protocol)
        radio.set_configuration(**settings)
        radio.send_communication_command(BroadcastMessageCommand("hello"))
        running.start_simulation()
        return calls

    return broadcast


def test_it_starts_with_the_settings_of_the_handler(heard):
    assert heard() == [(1, 0)]


@pytest.mark.parametrize(
    ("settings", "expected"),
    [
        ({"transmission_range": 10}, []),
        ({"transmission_range": 100}, [(1, 0), (2, 0)]),
        ({"delay": 0.5}, [(1, 0.5)]),
        ({"failure_rate": 1}, []),
    ],
)
def test_settings_of_its_own(heard, settings, expected):
    assert heard(**settings) == expected


def test_the_medium_of_the_others_stays(protocols):
    handler = CommunicationHandler(CommunicationMedium(transmission_range=60))
    protocol, *_ = protocols(POINTS, handler)
    Radio(protocol).set_configuration(transmission_range=1)
    assert handler.default_medium == CommunicationMedium(transmission_range=60)


@pytest.mark.parametrize("wrong", [{"transmission_range": -1}, {"delay": math.nan}, {"failure_rate": "high"}])
def test_wrong_settings_are_refused_by_name(protocols, wrong):
    protocol, *_ = protocols(POINTS, CommunicationHandler())
    with pytest.raises(ValueError, match=next(iter(wrong))):
        Radio(protocol).set_configuration(**wrong)


def test_wrong_commands_are_refused(protocols):
    protocol, *_ = protocols(POINTS, CommunicationHandler())
    with pytest.raises(CommunicationException):
        Radio(protocol).send_communication_command(SendMessageCommand("hello", 0))


def test_without_a_communication_handler_it_cannot_be(protocols):
    with pytest.raises(RuntimeError, match="CommunicationHandler"):
        Radio(*protocols([(0, 0, 0)]))


def test_outside_prototype_mode_the_error_names_the_mode(hosted):
    with pytest.raises(TypeError, match="InteropProvider"):
        Radio(hosted)


def test_without_a_provider_it_cannot_be(idle):
    with pytest.raises(ReferenceError):
        Radio(idle())
