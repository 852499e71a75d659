"""Mobility commands for a node that an autopilot flies."""

from typing import cast

from gradysim.encapsulator.validation import geo_target, is_speed, three_numbers, wrong_mobility
from gradysim.protocol.errors import MasslessMobilityException
from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    MobilityCommand,
    MobilityCommandType,
)
from gradysim.protocol.position import Position
from gradysim.sitl.pilot import Pilot


def give_order(command: MobilityCommand, node_id: int, reference: Position, pilot: Pilot) -> None:
    """Let the vehicle of a node carry out a mobility command: GOTO_COORDS, GOTO_GEO_COORDS or SET_SPEED.

    SET_SPEED has a ground speed or a velocity. `reference` is (latitude deg, longitude deg, altitude m) of
    the origin of geographic targets. MasslessMobilityException if the command cannot be carried out.
    """
    kind = getattr(command, "command_type", None)
    if kind == MobilityCommandType.GOTO_GEO_COORDS:
        command = GotoCoordsMobilityCommand(*geo_target(command, node_id, reference))
    if kind == MobilityCommandType.SET_SPEED and not is_speed(command):
        velocity = three_numbers(command)
        if velocity is None:
            raise MasslessMobilityException(
                f"node {node_id} got ({command.param_1!r}, {command.param_2!r}, {command.param_3!r}): "
                "expected three finite numbers"
            )
        pilot.set_velocity(velocity)
        return
    if wrong := wrong_mobility(command, node_id, can_move=True):
        raise MasslessMobilityException(wrong)
    if kind == MobilityCommandType.SET_SPEED:
        try:
            pilot.set_speed(float(cast("float", command.param_1)))
        except ValueError as error:
            raise MasslessMobilityException(
                f"node {node_id} got the speed {command.param_1!r}: {error}"
            ) from None
        return
    try:
        pilot.go_to(cast("Position", three_numbers(command)))
    except ValueError as error:
        raise MasslessMobilityException(f"node {node_id} was sent to an invalid place: {error}") from error
