"""Where a command to geographic coordinates sends a vehicle, in both modes."""

from gradysim.encapsulator.command_numbers import three_numbers
from gradysim.protocol.errors import MasslessMobilityException
from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.protocol.position import Position, geo_to_cartesian


def geo_target(command: MobilityCommand, node_id: int, reference_coordinates: Position) -> Position:
    """Return (x, y, z) in metres of the latitude (deg), longitude (deg) and altitude (m) of a command.

    Args:
        command: GOTO_GEO_COORDS.
        node_id: Who got it, for people.
        reference_coordinates: The same three of the origin of the frame.

    Raises:
        MasslessMobilityException: They are not three finite numbers, or the latitude is off the globe.
    """
    place = three_numbers(command)
    if place is None:
        raise MasslessMobilityException(
            f"node {node_id} was sent to latitude {command.param_1!r}, longitude {command.param_2!r}, "
            f"altitude {command.param_3!r}: expected three finite numbers"
        )
    if not -90 <= place[0] <= 90:
        raise MasslessMobilityException(
            f"node {node_id} was sent to latitude {command.param_1!r}: expected -90 to 90 degrees"
        )
    return geo_to_cartesian(reference_coordinates, place)
