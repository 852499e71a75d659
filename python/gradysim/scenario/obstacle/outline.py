"""The outline of an obstacle seen from above, and what can be wrong with it."""

import math
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from statistics import median

Corner = tuple[float, float]
"""x and y in metres."""

Ring = tuple[Corner, ...]
"""Corners of a closed line; the last one is joined to the first."""

_TOUCH_M = 0.1
"""Sides that reach no farther beyond each other only touch.

So much, a unit of the sixth decimal of a degree, is what rounding makes of a courtyard at a wall: GeoJSON
files mostly have no more decimals (The GeoJSON Format, RFC 7946, 2016, section 11.2).
"""

_FEW = 16
"""Comparisons of each side with others that are cheaper than to part the sides."""

_MOST_IN_BOTH = 0.25
"""Part of the sides that a line may meet; each half has three quarters of all at most, so there is an end."""


def encloses_nothing(ring: Ring) -> bool:
    """Whether all corners lie on one line."""
    (x, y), *others = ring
    sides = [(other_x - x, other_y - y) for other_x, other_y in others]
    dx, dy = max(sides, key=lambda side: math.hypot(*side))
    return all(dx * side_y == dy * side_x for side_x, side_y in sides)


def misplaced_ring(rings: Sequence[Ring]) -> tuple[int, int] | None:
    """An inner ring that is not within the first one, or that is within another inner one; None if none is.

    Given by its number and that of the other. For rings whose sides do not cross; here, too, they may touch.
    """
    outer, *inner = rings
    samples = [[*ring, _point_within(ring)] for ring in inner]
    for number, points in enumerate(samples, start=1):
        if any(_depth_m(point, outer) < -_TOUCH_M for point in points):
            return number, 0
    souths, norths = [min(ring)[0] for ring in inner], [max(ring)[0] for ring in inner]
    order = sorted(range(len(inner)), key=souths.__getitem__)
    for place, one in enumerate(order):
        for other in order[place + 1 :]:
            if souths[other] > norths[one]:
                break
            for within, around in ((other, one), (one, other)):
                if any(_depth_m(point, inner[around]) > _TOUCH_M for point in samples[within]):
                    return within + 1, around + 1
    return None


def _depth_m(point: Corner, ring: Ring) -> float:
    """How far from the ring a point is: positive if the ring is around it, negative outside."""
    x, y = point
    is_within = False
    nearest_m = math.inf
    begin_x, begin_y = ring[-1]
    for end_x, end_y in ring:
        dx, dy = end_x - begin_x, end_y - begin_y
        if (begin_y > y) != (end_y > y) and x < begin_x + dx * (y - begin_y) / dy:
            is_within = not is_within
        square = dx * dx + dy * dy
        along = ((x - begin_x) * dx + (y - begin_y) * dy) / square if square else 0.0
        along = min(max(along, 0.0), 1.0)
        nearest_m = min(nearest_m, math.hypot(begin_x + along * dx - x, begin_y + along * dy - y))
        begin_x, begin_y = end_x, end_y
    return nearest_m if is_within else -nearest_m


def _point_within(ring: Ring) -> Corner:
    """A point that the ring is around, if it is not thinner than any number: far from its sides."""
    heights = sorted({y for _, y in ring})
    low, high = max(pairwise(heights), key=lambda pair: pair[1] - pair[0])
    y = (low + high) / 2
    xs = sorted(
        begin[0] + (end[0] - begin[0]) * (y - begin[1]) / (end[1] - begin[1])
        for begin, end in zip(ring, (*ring[1:], ring[0]), strict=True)
        if (begin[1] > y) != (end[1] > y)
    )
    parts = zip(xs[::2], xs[1::2], strict=True)
    south, north = max(parts, key=lambda pair: pair[1] - pair[0], default=(ring[0][0], ring[0][0]))
    return (south + north) / 2, y


@dataclass(frozen=True)
class _Side:
    """Where it begins, as its ring and corner, and both ends."""

    ring: int
    corner: int
    begin: Corner
    end: Corner
    south: float
    """The least x."""
    north: float
    """The largest x."""


def crossing_sides(rings: Sequence[Ring]) -> tuple[tuple[int, int], tuple[int, int]] | None:
    """Two sides of one outline that cross, each by its ring and the corner where it begins; None if none do.

    Sides that touch, as those of a courtyard at the wall, or those around a corner that occurs twice, do not.
    """
    return _crossing_among(
        [
            _Side(ring, corner, begin, end, min(begin[0], end[0]), max(begin[0], end[0]))
            for ring, corners in enumerate(rings)
            for corner, (begin, end) in enumerate(zip(corners, (*corners[1:], corners[0]), strict=True))
        ]
    )


def _crossing_among(sides: list[_Side]) -> tuple[tuple[int, int], tuple[int, int]] | None:
    """The same, of these sides. Those that overlap in x are compared; if too many do, parted before."""
    sides = sorted(sides, key=lambda side: side.south)
    souths = [side.south for side in sides]
    ends = [bisect_right(souths, side.north) for side in sides]  # of those behind a side that overlap with it
    if sum(ends) - sum(range(1, len(sides) + 1)) > _FEW * len(sides) and (halves := _halves(sides)):
        return _crossing_among(halves[0]) or _crossing_among(halves[1])
    for index, (one, end) in enumerate(zip(sides, ends, strict=True), start=1):
        for other in sides[index:end]:
            if sides_cross(one.begin, one.end, other.begin, other.end):
                found = (one.ring, one.corner), (other.ring, other.corner)
                return min(found), max(found)
    return None


def _halves(sides: list[_Side]) -> tuple[list[_Side], list[_Side]] | None:
    """The sides on either side of a line, those that meet it in both halves; None if too many do.

    The line is along the longest side or across it: so the teeth of a comb are parted, in whatever direction
    they lie, and at its corner the two combs of an L.
    """
    longest = max(sides, key=lambda side: math.dist(side.begin, side.end))
    dx, dy = longest.end[0] - longest.begin[0], longest.end[1] - longest.begin[1]
    best: tuple[list[_Side], list[_Side]] | None = None
    fewest = len(sides) * _MOST_IN_BOTH
    for axis_x, axis_y in ((-dy, dx), (dx, dy)):
        spans = [
            sorted((axis_x * x + axis_y * y for x, y in (side.begin, side.end))) for side in sides
        ]  # of their shadows on the axis
        middle = median(low + high for low, high in spans) / 2
        below = [side for side, (low, _) in zip(sides, spans, strict=True) if low <= middle]
        above = [side for side, (_, high) in zip(sides, spans, strict=True) if high >= middle]
        if len(below) + len(above) - len(sides) < fewest:
            fewest = len(below) + len(above) - len(sides)
            best = below, above
    return best


def sides_cross(begin: Corner, end: Corner, c: Corner, d: Corner) -> bool:
    """Whether the side from `begin` to `end` and that from `c` to `d` reach beyond each other."""
    return _are_apart(begin, end, c, d) and _are_apart(c, d, begin, end)


def _are_apart(begin: Corner, end: Corner, c: Corner, d: Corner) -> bool:
    """Whether the line through `begin` and `end` has `c` on its one side and `d` on its other."""
    dx, dy = end[0] - begin[0], end[1] - begin[1]
    least = _TOUCH_M * math.hypot(dx, dy)
    of_c = dx * (c[1] - begin[1]) - dy * (c[0] - begin[0])
    of_d = dx * (d[1] - begin[1]) - dy * (d[0] - begin[0])
    return (of_c > least and of_d < -least) or (of_c < -least and of_d > least)
