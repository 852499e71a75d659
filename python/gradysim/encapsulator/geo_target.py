"""Where a command to geographic coordinates sends a vehicle, in both modes."""

import math

from gradysim.encapsulator.command_numbers import is_in_scene, three_numbers
from gradysim.protocol.errors import MasslessMobilityException
from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.protocol.position import LARGEST_COORDINATE_M, Position, geo_to_cartesian

_FAR_M = 100e3
"""Farther than nodes fly, as a rule."""
_SHARE = 1 / 20
"""Of that distance, within which the exchanged target is: where latitude and longitude are nearly the same
number, a place on the other side of the diagonal may well be meant."""


def geo_target(command: MobilityCommand, node_id: int, reference_coordinates: Position) -> Position:
    """Return (x, y, z) in metres of the latitude (deg), longitude (deg) and altitude (m) of a command.

    Args:
        command: GOTO_GEO_COORDS.
        node_id: Who got it, for people.
        reference_coordinates: The same three of the origin of the frame.

    Raises:
        MasslessMobilityException: They are not three finite numbers, the latitude is off the globe, the place
            is too far away, or latitude and longitude are exchanged: far away so, and much nearer the other
            way.
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
    target = geo_to_cartesian(reference_coordinates, place)
    if not is_in_scene(target):
        raise MasslessMobilityException(
            f"{_far_away(command, node_id, target)}; expected at most {LARGEST_COORDINATE_M} m on each axis"
        )
    latitude, longitude, altitude = place
    distance_m = math.hypot(*target[:2])
    if distance_m > _FAR_M and -90 <= longitude <= 90:
        exchanged = geo_to_cartesian(reference_coordinates, (longitude, latitude, altitude))
        if math.hypot(*exchanged[:2]) <= min(_FAR_M, distance_m * _SHARE):
            raise MasslessMobilityException(
                f"{_far_away(command, node_id, target)}; expected latitude before longitude: did you mean "
                f"latitude {longitude!r}, longitude {latitude!r}?"
            )
    return target


def _far_away(command: MobilityCommand, node_id: int, target: Position) -> str:
    return (
        f"node {node_id} was sent to latitude {command.param_1!r}, longitude {command.param_2!r}, "
        f"altitude {command.param_3!r}, which is {math.hypot(*target) / 1000:.0f} km from the origin of the"
        " scene"
    )
