"""Ways to place nodes."""

import random

from gradysim.protocol.checked_values import checked_range
from gradysim.protocol.position import Position


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
        box = [
            checked_range(f"{axis}_range", given, ValueError)
            for axis, given in zip("xyz", (x_range, y_range, z_range), strict=True)
        ]
        x, y, z = (random.uniform(lowest, highest) for lowest, highest in box)
        return (x, y, z)
