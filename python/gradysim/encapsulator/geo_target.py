"""Where a command to geographic coordinates sends a vehicle, in both modes."""

import math
from typing import TypeGuard

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
    latitude, longitude, altitude = command.param_1, command.param_2, command.param_3
    if not (_is_finite(latitude) and _is_finite(longitude) and _is_finite(altitude)):
        raise MasslessMobilityException(
            f"node {node_id} was sent to latitude {latitude!r}, longitude {longitude!r}, altitude "
            f"{altitude!r}: expected three finite numbers"
        )
    if not -90 <= latitude <= 90:
        raise MasslessMobilityException(
            f"node {node_id} was sent to latitude {latitude!r}: expected -90 to 90 degrees"
        )
    return geo_to_cartesian(reference_coordinates, (latitude, longitude, altitude))


def _is_finite(value: float | None) -> TypeGuard[float]:
    try:
        return value is not None and math.isfinite(value)
    except TypeError:
        return False
