"""Behavior that users rely on, and fixes of the published package: messages and positions."""

from typing import Any

import pytest

from gradysim.protocol.messages.communication import (
    BroadcastMessageCommand,
    CommunicationCommand,
    CommunicationCommandType,
    SendMessageCommand,
)
from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    GotoGeoCoordsMobilityCommand,
    MobilityCommand,
    MobilityCommandType,
    SetSpeedMobilityCommand,
    SetVelocityMobilityCommand,
)
from gradysim.protocol.position import geo_to_cartesian
from python.quiet_protocol import Quiet


def test_unused_parameters_of_a_mobility_command_are_none() -> None:
    command = MobilityCommand(MobilityCommandType.GOTO_COORDS)
    assert [getattr(command, f"param_{number}") for number in range(1, 7)] == [None] * 6


@pytest.mark.parametrize(
    ("command", "kind", "parameters"),
    [
        (GotoCoordsMobilityCommand(1, 2, 3), MobilityCommandType.GOTO_COORDS, (1, 2, 3)),
        (GotoGeoCoordsMobilityCommand(1, 2, 3), MobilityCommandType.GOTO_GEO_COORDS, (1, 2, 3)),
        (SetSpeedMobilityCommand(1), MobilityCommandType.SET_SPEED, (1, None, None)),
        (SetVelocityMobilityCommand(1, 2, 3), MobilityCommandType.SET_SPEED, (1, 2, 3)),
    ],
)
def test_mobility_commands_fill_in_type_and_parameters(
    command: MobilityCommand, kind: MobilityCommandType, parameters: tuple[float | None, ...]
) -> None:
    assert command.command_type is kind
    assert (command.param_1, command.param_2, command.param_3) == parameters


def test_a_broadcast_has_no_destination() -> None:
    assert BroadcastMessageCommand("hi").destination is None


def test_a_command_equals_only_one_of_its_own_class() -> None:
    assert SendMessageCommand("a", 1) == SendMessageCommand("a", 1)
    assert SendMessageCommand("a", 1) != CommunicationCommand(CommunicationCommandType.SEND, "a", 1)


def test_types_of_commands_are_numbers() -> None:
    assert isinstance(CommunicationCommandType.SEND, int)
    assert isinstance(MobilityCommandType.GOTO_COORDS, int)


def test_north_and_east_have_their_own_signs() -> None:
    x, y, z = geo_to_cartesian((10, 10, 0), (9.999, 10.001, 5))
    assert (x, y, z) == pytest.approx((-111.19, 109.51, 5), abs=0.01)


def test_a_protocol_is_made_without_arguments_and_then_given_its_provider() -> None:
    class Constructed(Quiet):
        def __init__(self) -> None:
            self.had_provider = hasattr(self, "provider")

    provider: Any = object()
    protocol = Constructed.instantiate(provider)
    assert (protocol.had_provider, protocol.provider) == (False, provider)
