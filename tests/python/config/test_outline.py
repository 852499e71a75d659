"""Outlines of obstacles that enclose nothing or cross themselves."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.config.outline import Ring, crossing_sides, encloses_nothing

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
