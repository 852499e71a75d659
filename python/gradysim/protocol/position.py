"""Points in space, and the flat frame in which a simulation places them.

The frame is Cartesian, in meters, with a reference point of the Earth at its origin: x to the North,
y to the East, z up.
"""

import math
from collections.abc import Sequence

Position = tuple[float, float, float]
"""(x, y, z) in meters."""

LARGEST_COORDINATE_M = 10_000_000
"""How far each coordinate of a node or a target is from the origin at most, in both modes."""

EARTH_RADIUS_M = 6_371_000.0
"""Mean radius of the Earth (IUGG R1, rounded)."""


def squared_distance(start: Position, end: Position) -> float:
    """Square of the distance between two points, m²; cheaper than the distance where only order matters."""
    dx = end[0] - start[0]
    dy = end[1] - start[1]
    dz = end[2] - start[2]
    return dx * dx + dy * dy + dz * dz


def geo_to_cartesian(ref_coord: Position, target_coord: Position) -> Position:
    """Place a geographic point in the frame whose origin is another one.

    Args:
        ref_coord: (latitude deg, longitude deg, altitude m) of the origin; latitudes are -90 to 90 deg,
            longitudes any angle, and nothing is checked.
        target_coord: The same of the point.

    Returns:
        (x, y, z) in meters: North, East and up of the origin. x is the length of the meridian between
        the two latitudes, y the great-circle distance between the two longitudes at the origin's latitude.
    """
    latitude, longitude, altitude = ref_coord
    target_latitude, target_longitude, target_altitude = target_coord
    north = _haversine_distance((latitude, longitude), (target_latitude, longitude))
    east = _haversine_distance((latitude, longitude), (latitude, target_longitude))
    # The shorter way round decides the side: 179.9 deg W lies East of 179.9 deg E.
    longitude_difference = (target_longitude - longitude + 180.0) % 360.0 - 180.0
    return (
        math.copysign(north, target_latitude - latitude),
        math.copysign(east, longitude_difference),
        target_altitude - altitude,
    )


def rotate_position_2d(position: Position, angle_degrees: float) -> Position:
    """Turn a point about the z axis, from x (North) towards y (East); z stays."""
    cosine = math.cos(math.radians(angle_degrees))
    sine = math.sin(math.radians(angle_degrees))
    x, y, z = position
    return (x * cosine - y * sine, x * sine + y * cosine, z)


def _haversine_distance(coord1: Sequence[float], coord2: Sequence[float]) -> float:
    """Great-circle distance in meters between two points (latitude deg, longitude deg).

    The haversine formula (R. W. Sinnott, Virtues of the Haversine, Sky and Telescope 68, 1984).
    """
    phi_1 = math.radians(coord1[0])
    phi_2 = math.radians(coord2[0])
    sin_lat = math.sin((phi_2 - phi_1) / 2.0)
    sin_lon = math.sin(math.radians(coord2[1] - coord1[1]) / 2.0)
    square = sin_lat * sin_lat + math.cos(phi_1) * math.cos(phi_2) * sin_lon * sin_lon
    return 2.0 * EARTH_RADIUS_M * math.asin(min(1.0, math.sqrt(square)))
