"""Conversion from the simulation's frame to geographic coordinates: the inverse of `geo_to_cartesian`."""

import math

from gradysim.protocol.position import EARTH_RADIUS_M, Position

_SMALLEST_DEG = 1e-7
"""Resolution of MAVLink's latitudes and longitudes, 1.1 cm."""

_ARDUPILOTS_EARTH_M = 6_378_100.0
"""Radius of the Earth in ArduPilot."""


def cartesian_to_geo(ref_coord: Position, position: Position) -> Position:
    """Return the geographic position of a point, the inverse of `geo_to_cartesian(ref_coord, ...)`.

    It inverts the haversine formula along the meridian and along the parallel of the origin
    (R. W. Sinnott, Virtues of the Haversine, Sky and Telescope 68, 1984).

    Both geographic positions are (latitude deg, longitude deg, altitude m). Raise ValueError if there is no
    such point on Earth.
    """
    latitude, longitude, altitude = ref_coord
    north, east, up = position
    target_latitude = latitude + math.degrees(north / EARTH_RADIUS_M)
    sine = math.sin(east / (2.0 * EARTH_RADIUS_M))
    cosine = math.cos(math.radians(latitude))
    if abs(target_latitude) > 90.0 or abs(sine) > cosine:
        raise ValueError(f"{position!r} m is beyond the Earth's edge, seen from {ref_coord!r}")
    half_angle = math.asin(sine / cosine)
    target_longitude = (longitude + math.degrees(2.0 * half_angle) + 180.0) % 360.0 - 180.0
    return (target_latitude, target_longitude, altitude + up)


def home_of(ref_coord: Position, position: Position) -> Position:
    """Return the position on the ground below a point, at the altitude of the reference."""
    latitude, longitude, altitude = cartesian_to_geo(ref_coord, (position[0], position[1], 0.0))
    return (*off_null_island(latitude, longitude), altitude)


def off_null_island(latitude: float, longitude: float) -> tuple[float, float]:
    """Return the position, moved 1 cm North if it is latitude and longitude 0.

    To ArduPilot (0, 0) means "not given": it starts in Australia then, and does not fly there.
    """
    if max(abs(latitude), abs(longitude)) <= _SMALLEST_DEG / 2:
        return (_SMALLEST_DEG, 0.0)
    return (latitude, longitude)


def check_same_hemisphere(home: Position, longitude: float) -> None:
    """Raise ValueError if the date line is between home and a longitude.

    ArduPilot does not wrap the difference of two longitudes, so it would fly the long way round.
    """
    if abs(longitude - home[1]) > 180.0:
        raise ValueError(
            f"ArduPilot cannot fly across the date line, from longitude {home[1]:.4f} to {longitude:.4f}"
        )


def autopilots_coordinates(home: Position, offset: Position) -> Position:
    """Return (latitude deg, longitude deg, height above home m) at an offset (North, East, up; m) from home.

    ArduPilot computes it with a flat Earth. Raise ValueError if the place is across the date line.
    """
    latitude, longitude, _ = home
    north, east, up = offset
    parallel_m = _ARDUPILOTS_EARTH_M * math.cos(math.radians(latitude))
    target_longitude = (longitude + math.degrees(east / parallel_m) + 180.0) % 360.0 - 180.0
    check_same_hemisphere(home, target_longitude)
    return (latitude + math.degrees(north / _ARDUPILOTS_EARTH_M), target_longitude, up)
