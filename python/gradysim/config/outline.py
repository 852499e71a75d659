"""The outline of an obstacle seen from above, and what can be wrong with it."""

import math
from collections.abc import Iterator, Sequence

Corner = tuple[float, float]
"""x and y in metres."""

Ring = tuple[Corner, ...]
"""Corners of a closed line; the last one is joined to the first."""

_TOUCH_M = 0.1
"""Sides that reach no farther beyond each other only touch.

So much, a unit of the sixth decimal of a degree, is what rounding makes of a courtyard at a wall: GeoJSON
files mostly have no more decimals (The GeoJSON Format, RFC 7946, 2016, section 11.2).
"""


def encloses_nothing(ring: Ring) -> bool:
    """Whether all corners lie on one line."""
    (x, y), *others = ring
    sides = [(other_x - x, other_y - y) for other_x, other_y in others]
    dx, dy = max(sides, key=lambda side: math.hypot(*side))
    return all(dx * side_y == dy * side_x for side_x, side_y in sides)


def crossing_sides(rings: Sequence[Ring]) -> tuple[tuple[int, int], tuple[int, int]] | None:
    """Two sides of one outline that cross, each by its ring and the corner where it begins; None if none do.

    Sides that touch, as those of a courtyard at the wall, or those around a corner that occurs twice, do not.
    """
    sides = sorted(_sides(rings))
    for first, (_, east, ring, corner, a, b) in enumerate(sides, start=1):
        for west, _, other_ring, other_corner, c, d in sides[first:]:
            if west > east:  # as all behind it in this order
                break
            if _are_apart(a, b, c, d) and _are_apart(c, d, a, b):
                found = (ring, corner), (other_ring, other_corner)
                return min(found), max(found)
    return None


def _sides(rings: Sequence[Ring]) -> Iterator[tuple[float, float, int, int, Corner, Corner]]:
    """Least x, largest x, ring, corner where it begins, both ends."""
    for index, ring in enumerate(rings):
        for corner, (begin, end) in enumerate(zip(ring, (*ring[1:], ring[0]), strict=True)):
            yield min(begin[0], end[0]), max(begin[0], end[0]), index, corner, begin, end


def _are_apart(begin: Corner, end: Corner, c: Corner, d: Corner) -> bool:
    """Whether the line through `begin` and `end` has `c` on its one side and `d` on its other."""
    dx, dy = end[0] - begin[0], end[1] - begin[1]
    least = _TOUCH_M * math.hypot(dx, dy)
    of_c = dx * (c[1] - begin[1]) - dy * (c[0] - begin[0])
    of_d = dx * (d[1] - begin[1]) - dy * (d[0] - begin[0])
    return (of_c > least and of_d < -least) or (of_c < -least and of_d > least)
