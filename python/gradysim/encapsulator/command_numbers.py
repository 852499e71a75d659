"""Parameters of mobility commands as numbers: what a protocol puts there may be anything."""

import math

from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.protocol.position import LARGEST_COORDINATE_M, Position


def finite_number(value: float | None) -> float | None:
    """Return `value` as a float; None if it is no finite number."""
    try:
        return float(value) if value is not None and math.isfinite(value) else None
    except (TypeError, ValueError, OverflowError):
        return None


def is_in_scene(point: Position) -> bool:
    """Return whether each coordinate is near enough to the origin."""
    return all(abs(coordinate) <= LARGEST_COORDINATE_M for coordinate in point)


def three_numbers(command: MobilityCommand) -> Position | None:
    """Return the first three parameters of a command as floats; None if one is no finite number."""
    x, y, z = map(finite_number, (command.param_1, command.param_2, command.param_3))
    return None if x is None or y is None or z is None else (x, y, z)
