"""From a protocol's mobility command to an order for the vehicle that flies its node."""

from typing import Protocol, cast

from gradysim.encapsulator.command_numbers import three_numbers
from gradysim.encapsulator.geo_target import geo_target
from gradysim.encapsulator.refused_commands import wrong_mobility
from gradysim.protocol.errors import MasslessMobilityException
from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    MobilityCommand,
    MobilityCommandType,
)
from gradysim.protocol.position import Position


class FlightOrders(Protocol):
    """What a vehicle can be told."""

    def go_to(self, target: Position) -> None:
        """Fly to a point (x, y, z) in metres; ValueError if there is no such place on Earth."""

    def set_speed(self, speed_mps: float) -> None:
        """Fly at this ground speed, >= 0; ValueError if it cannot."""

    def set_velocity(self, velocity_mps: Position) -> None:
        """Hold a velocity (North, East, up)."""


def give_order(command: MobilityCommand, node_id: int, reference: Position, vehicle: FlightOrders) -> None:
    """Hand a command on.

    Args:
        command: GOTO_COORDS, GOTO_GEO_COORDS, or SET_SPEED with one parameter, a ground speed, or three, a
            velocity.
        node_id: Of the node, for messages.
        reference: (latitude deg, longitude deg, altitude m) of the origin of geographic targets.
        vehicle: Who is to obey.

    Raises:
        MasslessMobilityException: The command cannot be carried out, in the words of all other modes.
    """
    if getattr(command, "command_type", None) == MobilityCommandType.GOTO_GEO_COORDS:
        command = GotoCoordsMobilityCommand(*geo_target(command, node_id, reference))
    if _is_velocity(command):
        velocity = three_numbers(command)
        if velocity is None:
            raise MasslessMobilityException(
                f"node {node_id} was given ({command.param_1!r}, {command.param_2!r}, {command.param_3!r}): "
                "expected three finite numbers"
            )
        vehicle.set_velocity(velocity)
        return
    if wrong := wrong_mobility(command, node_id, can_move=True):
        raise MasslessMobilityException(wrong)
    if command.command_type == MobilityCommandType.SET_SPEED:
        try:
            vehicle.set_speed(float(cast("float", command.param_1)))
        except ValueError as error:
            raise MasslessMobilityException(
                f"node {node_id} was given the speed {command.param_1!r}: {error}"
            ) from None
        return
    try:
        vehicle.go_to(cast("Position", three_numbers(command)))
    except ValueError as error:
        raise MasslessMobilityException(
            f"node {node_id} was sent to a place that is none: {error}"
        ) from error


def _is_velocity(command: MobilityCommand) -> bool:
    """Whether a command sets three components of a velocity."""
    return getattr(command, "command_type", None) == MobilityCommandType.SET_SPEED and not (
        command.param_2 is command.param_3 is None
    )
