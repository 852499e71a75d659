"""Ways to place nodes."""

import math
import random

from gradysim.protocol.position import Position
from gradysim.simulator.number_range import is_in_range


class PositionScheme:
    """Functions that give the initial position of a node."""

    @staticmethod
    def random(
        x_range: tuple[float, float] = (-10, 10),
        y_range: tuple[float, float] = (-10, 10),
        z_range: tuple[float, float] = (0, 10),
    ) -> Position:
        """Draw a point of a box (m) uniformly, from Python's global stream of random numbers.

        Raises:
            ValueError: A range is not (low, high) of finite numbers, low <= high.
        """
        for axis, given in zip("xyz", (x_range, y_range, z_range), strict=True):
            if not _is_range(given):
                raise ValueError(f"{axis}_range must be (low, high), two finite numbers, got {given!r}")
        return (random.uniform(*x_range), random.uniform(*y_range), random.uniform(*z_range))


def _is_range(given: tuple[float, float]) -> bool:
    try:
        low, high = given
    except (TypeError, ValueError):
        return False
    return is_in_range(low, -math.inf, above=True) and is_in_range(high, low)
