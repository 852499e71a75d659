"""Ways to place nodes."""

import random

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
            ValueError: A range's first number is greater than its second.
        """
        for axis, (low, high) in zip("xyz", (x_range, y_range, z_range), strict=True):
            if not low <= high:
                raise ValueError(f"{axis}_range must go from low to high, got ({low!r}, {high!r})")
        return (random.uniform(*x_range), random.uniform(*y_range), random.uniform(*z_range))
