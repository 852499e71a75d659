"""Given paths of nodes, which follow from the configuration alone: their positions in closed form.

Integrated mode flies the same paths (cpp/netsim/mobility/path.hpp). Names and directions are those of INET.
"""

import math
from collections.abc import Callable, Mapping
from functools import partial

from gradysim.protocol.defaults import SPEED_MPS
from gradysim.protocol.position import LARGEST_COORDINATE_M, Position
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.schema.keys import CIRCLE, LINEAR, RECTANGLE
from gradysim.scenario.schema.values import Setting

Path = Callable[[float], Position]
"""Returns the position in meters at a simulated time in seconds."""

LARGEST_GAP_M = 0.01
"""How far inside of its circle a node may fly: between two corners of the polygon."""

_LEAST_SIDES = 8
_AXES = ("x", "y", "z")


def path_of(mobility: Mapping[str, Setting], start: Position) -> Path | None:
    """Return the path of a node with these fields of MobilityConfig; None if it has no given path.

    `start` is the initial position in meters, as far as the path does not set it: for a line all of it, for a
    rectangle its height.

    Raises:
        ConfigError: The area or the radius is missing, the area is empty, or `start` is outside of it.
    """
    typename = mobility.get("typename")
    if typename is None or typename.value not in _PATHS:
        return None
    return _PATHS[typename.value](mobility, start, typename)


def _number(mobility: Mapping[str, Setting], field: str, default: float = 0.0) -> float:
    return float(mobility[field].value) if field in mobility else default


def _speed_mps(mobility: Mapping[str, Setting]) -> float:
    return _number(mobility, "speed_mps", SPEED_MPS)


def _walls(mobility: Mapping[str, Setting], axis: str) -> tuple[float, float]:
    """Return the ends of the area along an axis. Raises ConfigError if they are exchanged."""
    least = _number(mobility, f"area_min_{axis}_m", -LARGEST_COORDINATE_M)
    most = _number(mobility, f"area_max_{axis}_m", LARGEST_COORDINATE_M)
    if least > most:
        setting = mobility.get(f"area_max_{axis}_m") or mobility[f"area_min_{axis}_m"]
        expected = f"constraintAreaMax{axis.upper()} to be at least constraintAreaMin{axis.upper()}"
        raise ConfigError.at(
            setting.source, f"the area ends at {most:g}m and begins at {least:g}m", expected=expected
        )
    return least, most


# ---- a line, reflected at the walls ------------------------------------------------------------------------


def _linear(mobility: Mapping[str, Setting], start: Position, typename: Setting) -> Path:
    speed_mps = _speed_mps(mobility)
    heading = _number(mobility, "movement_heading_rad")
    elevation = _number(mobility, "movement_elevation_rad")
    shares = (
        math.cos(elevation) * math.cos(heading),
        math.cos(elevation) * math.sin(heading),
        math.sin(elevation),
    )
    walls = [_walls(mobility, axis) for axis in _AXES]
    for axis, coordinate, (least, most) in zip(_AXES, start, walls, strict=True):
        if not least <= coordinate <= most:
            text = f"the node starts at {axis} = {coordinate:g}m"
            setting = mobility.get(f"area_{'min' if coordinate < least else 'max'}_{axis}_m", typename)
            raise ConfigError.at(setting.source, text, expected=f"{least:g}m to {most:g}m, in the area")
    lines = [
        partial(_reflected, coordinate - least, speed_mps * share, least, most - least)
        for coordinate, share, (least, most) in zip(start, shares, walls, strict=True)
    ]
    return lambda time_s: (lines[0](time_s), lines[1](time_s), lines[2](time_s))


def _reflected(start_m: float, speed_mps: float, least_m: float, room_m: float, time_s: float) -> float:
    """Return a coordinate between two walls, `room_m` apart; `start_m` is from the first of them."""
    if room_m == 0 or speed_mps == 0:
        return least_m + start_m
    return least_m + min(abs(math.remainder(start_m + speed_mps * time_s, 2 * room_m)), room_m)


# ---- a circle, as a polygon --------------------------------------------------------------------------------


def _circle(mobility: Mapping[str, Setting], start: Position, typename: Setting) -> Path:
    radius_m = _number(mobility, "radius_m")
    if radius_m == 0:
        raise ConfigError.at(typename.source, "nothing sets the radius", expected="`mobility.r = 100m`")
    center_x, center_y, center_z = (_number(mobility, f"center_{axis}_m") for axis in _AXES)
    start_rad = _number(mobility, "start_angle_rad")
    turn_rad = 2 * math.pi / _sides(radius_m)
    speed_mps = _speed_mps(mobility)

    def corner(number: int) -> Position:
        angle = start_rad + number * turn_rad
        return (center_x + radius_m * math.cos(angle), center_y + radius_m * math.sin(angle), center_z)

    def position(time_s: float) -> Position:
        sides = time_s * speed_mps / (turn_rad * radius_m)
        number = math.floor(sides)
        return _between(corner(number), corner(number + 1), sides - number)

    return position


def _sides(radius_m: float) -> int:
    """Return the number of sides of the polygon: its sagitta r (1 - cos(pi/n)) is at most LARGEST_GAP_M."""
    if radius_m <= 10 * LARGEST_GAP_M:
        return _LEAST_SIDES
    return max(_LEAST_SIDES, math.ceil(math.pi / math.acos(1 - LARGEST_GAP_M / radius_m)))


def _between(one: Position, other: Position, share: float) -> Position:
    x, y, z = (here + (there - here) * share for here, there in zip(one, other, strict=True))
    return (x, y, z)


# ---- the border of the area --------------------------------------------------------------------------------


def _rectangle(mobility: Mapping[str, Setting], start: Position, typename: Setting) -> Path:
    missing = [
        f"constraintArea{end.capitalize()}{axis.upper()}"
        for axis in _AXES[:2]
        for end in ("min", "max")
        if f"area_{end}_{axis}_m" not in mobility
    ]
    if missing:
        raise ConfigError.at(
            typename.source, f"nothing sets {' and '.join(missing)}", expected="the area that it flies around"
        )
    (west, east), (south, north) = _walls(mobility, "x"), _walls(mobility, "y")
    width_m, height_m = east - west, north - south
    corners_m = (0.0, width_m, width_m + height_m, 2 * width_m + height_m, 2 * (width_m + height_m))
    side, share = divmod(_number(mobility, "start_pos") % 4, 1)
    start_m = corners_m[int(side)] + share * (height_m if side % 2 else width_m)
    speed_mps = _speed_mps(mobility)

    def position(time_s: float) -> Position:
        way_m = math.fmod(start_m + speed_mps * time_s, corners_m[4]) if corners_m[4] else 0.0
        if way_m < corners_m[1]:
            return (west + way_m, south, start[2])
        if way_m < corners_m[2]:
            return (west + width_m, south + way_m - corners_m[1], start[2])
        if way_m < corners_m[3]:
            return (west + corners_m[3] - way_m, south + height_m, start[2])
        return (west, south + corners_m[4] - way_m, start[2])

    return position


_PATHS: Mapping[object, Callable[[Mapping[str, Setting], Position, Setting], Path]] = {
    LINEAR: _linear,
    CIRCLE: _circle,
    RECTANGLE: _rectangle,
}
