"""Outlines of obstacles that enclose nothing or cross themselves."""

import math
from itertools import combinations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.obstacle.outline import (
    Ring,
    crossing_sides,
    encloses_nothing,
    misplaced_ring,
    sides_cross,
)

SQUARE: Ring = ((0, 0), (10, 0), (10, 10), (0, 10))


def test_corners_on_one_line_enclose_nothing() -> None:
    assert encloses_nothing(((0, 0), (1, 2), (3, 6)))
    assert not encloses_nothing(SQUARE)


@pytest.mark.parametrize(
    "rings",
    [
        [SQUARE],
        [SQUARE[::-1]],
        [SQUARE, ((3, 3), (3, 7), (7, 7))],
        [SQUARE, ((0, 3), (0, 7), (7, 7))],  # a courtyard at the wall
        [((0, 0), (10, 0), (10, 0), (10, 10), (0, 10))],  # a corner twice
        [((0, 0), (5, 0), (10, 0), (10, 10), (0, 10))],  # a corner that is none
        [((0, 0), (10, 0), (10, 10), (10, 20), (10, 10), (0, 10))],  # there and back
        [((0, 0), (5, 5), (10, 0), (10, 10), (5, 5), (0, 10))],  # two triangles that meet in a corner
        [((0, 0), (10, 0), (10, 10), (5, -0.05), (0, 10))],  # touches as far as anybody can know
        [((0, 0), (10, 0.05), (10, 10), (0, 10)), ((3, 0), (7, 0), (5, 5))],  # at the wall but for rounding
    ],
)
def test_sides_that_touch_do_not_cross(rings: list[Ring]) -> None:
    assert crossing_sides(rings) is None


def test_finds_the_sides_that_cross() -> None:
    bow_tie = ((0.0, 0.0), (10.0, 0.0), (0.0, 10.0), (10.0, 10.0))
    assert crossing_sides([bow_tie]) == ((0, 1), (0, 3))
    assert crossing_sides([SQUARE, ((5, 5), (5, 7), (12, 6))]) == ((0, 1), (1, 1))


def moved(ring: Ring, x: float, y: float) -> Ring:
    return tuple((corner_x + x, corner_y + y) for corner_x, corner_y in ring)


YARD: Ring = ((3, 3), (3, 7), (7, 7), (7, 3))
U: Ring = ((0, 0), (10, 0), (10, 10), (7, 10), (7, 3), (3, 3), (3, 10), (0, 10))


@pytest.mark.parametrize(
    "rings",
    [
        [SQUARE],
        [SQUARE, YARD],
        [SQUARE[::-1], YARD],
        [SQUARE, ((0, 0), (10, 0), (5, 10))],  # all of its corners at the wall
        [SQUARE, ((0, 3), (0, 7), (7, 7))],
        [SQUARE, ((-0.05, 3), (-0.05, 7), (7, 7))],  # at the wall but for rounding
        [SQUARE, ((1, 1), (1, 2), (2, 1)), ((2, 1), (1, 2), (2, 2))],  # courtyards side by side
        [U, ((8, 1), (9, 1), (8, 9))],
        [SQUARE, ((2, 2), (2, 5e-324), (3, 0))],
        [((0, 0), (9, 5e-324), (9, 0))] * 2,  # thinner than any number
    ],
)
def test_courtyards_are_within_the_outer_ring(rings: list[Ring]) -> None:
    assert misplaced_ring(rings) is None


@pytest.mark.parametrize(
    ("rings", "found"),
    [
        ([SQUARE, moved(YARD, 100, 0)], (1, 0)),
        ([SQUARE, YARD, moved(YARD, 0, 8)], (2, 0)),
        ([YARD, SQUARE], (1, 0)),  # exchanged
        ([U, ((3, 10), (3, 3), (7, 3), (7, 10))], (1, 0)),  # what the outer ring leaves out
        ([SQUARE, ((5, 5), (10, 4), (12, 5), (10, 6))], (1, 0)),  # leaves through the wall by corners
        ([SQUARE, YARD, ((4, 4), (4, 6), (6, 6))], (2, 1)),
        ([SQUARE, ((4, 4), (4, 6), (6, 6)), YARD], (1, 2)),
        ([SQUARE, YARD, YARD[::-1]], (2, 1)),  # the same once more
    ],
)
def test_finds_the_ring_that_is_no_courtyard(rings: list[Ring], found: tuple[int, int]) -> None:
    assert crossing_sides(rings) is None
    assert misplaced_ring(rings) == found


@given(st.lists(st.floats(1, 100), min_size=3, max_size=12), st.floats(0, 7), st.floats(0.01, 0.9))
def test_a_smaller_star_is_within_one_of_its_form(
    radii: list[float], turned_rad: float, scale: float
) -> None:
    large, small = (tuple(star([factor * r for r in radii], turned_rad)) for factor in (1.0, scale))
    assert misplaced_ring([large, small]) is None
    assert misplaced_ring([small, moved(large, 250, 0)]) == (1, 0)


def star(radii: list[float], turned_rad: float = 0.0) -> list[tuple[float, float]]:
    angles = [turned_rad + 2 * math.pi * index / len(radii) for index in range(len(radii))]
    return [(r * math.cos(angle), r * math.sin(angle)) for r, angle in zip(radii, angles, strict=True)]


@given(st.lists(st.floats(1, 100), min_size=4, max_size=12), st.floats(0, 7))
def test_a_star_does_not_cross_itself(radii: list[float], turned_rad: float) -> None:
    assert crossing_sides([tuple(star(radii, turned_rad))]) is None


@given(st.integers(4, 12), st.floats(0, 7), st.data())
def test_two_corners_exchanged_make_sides_cross(count: int, turned_rad: float, data: st.DataObject) -> None:
    ring = star([10.0] * count, turned_rad)
    at = data.draw(st.integers(0, count - 2))
    ring[at : at + 2] = reversed(ring[at : at + 2])
    assert crossing_sides([tuple(ring)]) is not None


def comb(teeth: int, turned_rad: float, length_m: float = 100.0) -> Ring:
    """A wall with long teeth, which all overlap as seen from their side."""
    corners = [(-1.0, 0.0)]
    for y in range(0, 2 * teeth, 2):
        corners += [(length_m, y), (length_m, y + 1), (0.0, y + 1), (0.0, y + 2)]
    corners.append((-1.0, 2.0 * teeth))
    cos, sin = math.cos(turned_rad), math.sin(turned_rad)
    return tuple((cos * x - sin * y, sin * x + cos * y) for x, y in corners)


@given(st.integers(1, 60), st.floats(0, 7))
def test_the_teeth_of_a_comb_do_not_cross(teeth: int, turned_rad: float) -> None:
    assert crossing_sides([comb(teeth, turned_rad)]) is None


@given(st.integers(20, 60), st.floats(0, 7), st.data())
def test_one_bent_tooth_of_a_comb_is_found(teeth: int, turned_rad: float, data: st.DataObject) -> None:
    at = data.draw(st.integers(0, teeth - 2))
    ring = list(comb(teeth, turned_rad))
    ring[1 + 4 * at] = ring[1 + 4 * (at + 1) + 2]  # the tip is bent across the next tooth
    found = crossing_sides([tuple(ring)])
    assert found is not None
    assert all(4 * at <= corner <= 4 * (at + 2) for _, corner in found)


coordinates = st.floats(-50, 50)
corners_of_a_ring = st.lists(st.tuples(coordinates, coordinates), min_size=3, max_size=80).map(tuple)


@given(st.lists(corners_of_a_ring, min_size=1, max_size=3))
def test_agrees_with_the_comparison_of_each_side_with_each(rings: list[Ring]) -> None:
    sides = {
        (ring, corner): (corners[corner], corners[(corner + 1) % len(corners)])
        for ring, corners in enumerate(rings)
        for corner in range(len(corners))
    }
    crossing = {
        (one, other)
        for one, other in combinations(sorted(sides), 2)
        if sides_cross(*sides[one], *sides[other])
    }
    found = crossing_sides(rings)
    assert found in crossing if crossing else found is None
