import pytest

from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    GotoGeoCoordsMobilityCommand,
    MobilityCommand,
    MobilityCommandType,
    SetSpeedMobilityCommand,
    SetVelocityMobilityCommand,
)


def parameters(command):
    return [getattr(command, f"param_{number}") for number in range(1, 7)]


@pytest.mark.parametrize(
    ("command", "command_type", "expected"),
    [
        (GotoCoordsMobilityCommand(1, 2, 3), 1, [1, 2, 3, None, None, None]),
        (GotoGeoCoordsMobilityCommand(1, 2, 3), 2, [1, 2, 3, None, None, None]),
        (SetSpeedMobilityCommand(4), 3, [4, None, None, None, None, None]),
        (SetVelocityMobilityCommand(1, 2, 3), 3, [1, 2, 3, None, None, None]),
        (MobilityCommand(MobilityCommandType.SET_SPEED), 3, [None] * 6),
    ],
)
def test_type_and_parameters(command, command_type, expected):
    assert (command.command_type, parameters(command)) == (command_type, expected)
