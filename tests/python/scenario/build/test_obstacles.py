"""Obstacles in .ini files, and the checks of their outlines."""

import math
from itertools import combinations
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.scenario.build.obstacles import crossing_sides, encloses_nothing, misplaced_ring, sides_cross
from gradysim.scenario.errors import ConfigError, ConfigErrors
from gradysim.scenario.obstacle_spec import ObstacleSpec, Ring

BOX = """*.environment.numObstacles = 1
*.environment.obstacle[0].minX = 0m
*.environment.obstacle[0].maxX = 10m
*.environment.obstacle[0].minY = -5m
*.environment.obstacle[0].maxY = 5m
*.environment.obstacle[0].minZ = 1m
*.environment.obstacle[0].maxZ = 20m
"""

PRISM = """*.environment.numObstacles = 1
*.environment.obstacle[0].typename = "prism"
*.environment.obstacle[0].points = "0 0 10 0 10 5.5"
*.environment.obstacle[*].minZ = 0m
*.environment.obstacle[*].maxZ = 20m
"""


def only(obstacles: tuple[ObstacleSpec, ...]) -> ObstacleSpec:
    (obstacle,) = obstacles
    return obstacle


def test_there_are_none_by_default(folder: Any) -> None:
    assert folder.load().obstacles == ()


def test_a_box(folder: Any) -> None:
    box = only(folder.load(BOX).obstacles)
    assert box.rings == (((0.0, -5.0), (10.0, -5.0), (10.0, 5.0), (0.0, 5.0)),)
    assert (box.base_m, box.top_m, box.material) == (1.0, 20.0, "concrete")
    assert (box.relative_permittivity, box.conductivity_spm) == (-1.0, -1.0)
    assert (box.name, box.source.line) == ("obstacle[0]", 7)
    assert {target: source.line for target, source in box.sources.items()} == {
        "obstacle.min_x": 7,
        "obstacle.max_x": 8,
        "obstacle.min_y": 9,
        "obstacle.max_y": 10,
        "obstacle.min_z": 11,
        "obstacle.max_z": 12,
    }


def test_a_box_is_turned_about_its_middle(folder: Any) -> None:
    box = only(folder.load(BOX + "*.environment.obstacle[0].heading = 90deg\n").obstacles)
    xs, ys = zip(*box.rings[0], strict=True)
    assert xs == pytest.approx((10.0, 10.0, 0.0, 0.0))
    assert ys == pytest.approx((-5.0, 5.0, 5.0, -5.0))


def test_a_material_of_its_own(folder: Any) -> None:
    added = (
        '*.environment.obstacle[*].material = "wood"\n'
        "*.environment.obstacle[0].relativePermittivity = 3\n"
        "*.environment.obstacle[0].conductivity = 0.02\n"
    )
    box = only(folder.load(BOX + added).obstacles)
    assert (box.material, box.relative_permittivity, box.conductivity_spm) == ("wood", 3.0, 0.02)


def test_a_prism(folder: Any) -> None:
    assert only(folder.load(PRISM).obstacles).rings == (((0.0, 0.0), (10.0, 0.0), (10.0, 5.5)),)


def test_a_pattern_sets_values_of_several_obstacles(folder: Any) -> None:
    added = PRISM.replace("numObstacles = 1", "numObstacles = 2").replace("obstacle[0]", "obstacle[*]")
    assert [obstacle.name for obstacle in folder.load(added).obstacles] == ["obstacle[0]", "obstacle[1]"]


@pytest.mark.parametrize(
    ("text", "line", "names"),
    [
        (BOX.replace("*.environment.obstacle[0].maxY = 5m\n", ""), 7, "maxY"),
        (BOX.replace("maxX = 10m", "maxX = -1m"), 8, "minX"),
        (BOX.replace("maxZ = 20m", "maxZ = 1m"), 12, "minZ"),
        (BOX + '*.environment.obstacle[0].points = "0 0 1 0 1 1"\n', 13, "prism"),
        (PRISM.replace('*.environment.obstacle[0].points = "0 0 10 0 10 5.5"\n', ""), 7, "points"),
        (PRISM.replace("10 5.5", "10"), 8, "corners"),
        (PRISM.replace("10 5.5", "10 north"), 8, "corners"),
        (PRISM.replace("10 5.5", "20 0"), 8, "line"),
        (PRISM.replace("10 0 10 5.5", "10 0 0 10 10 10"), 8, "(10, 0) to (0, 10)"),
        (PRISM.replace("10 0", "20000000 0"), 8, "(2e+07, 0)"),
        (
            BOX.replace("maxX = 10m", "maxX = 10000km").replace("maxY = 5m", "maxY = 10000km")
            + "*.environment.obstacle[0].heading = 45deg\n",
            13,
            "(1.20711e+07, 5e+06)",
        ),
        (PRISM + "*.environment.obstacle[0].heading = 90deg\n", 11, "box"),
        (BOX + '*.environment.obstacle[0].material = "bricks"\n', 13, "`brick`"),
        (BOX + "*.environment.obstacle[0].minx = 5m\n", 13, "minX"),
        (BOX.replace("numObstacles = 1", "numObstacles = 0"), 7, "`*.environment.numObstacles`"),
        (BOX + "*.environment.obstacle[1].minX = 5m\n", 13, "`*.environment.numObstacles`"),
        ("*.environment.numObstacle = 1\n", 6, "*.environment.numObstacles"),
    ],
)
def test_an_error_has_its_line_and_names_what_is_wrong(folder: Any, text: str, line: int, names: str) -> None:
    with pytest.raises(ConfigError) as error:
        folder.load(text)
    assert error.value.line == line
    assert names in error.value.message


def test_errors_of_all_obstacles_are_reported_at_once(folder: Any) -> None:
    lines = """*.environment.numObstacles = 4
*.environment.obstacle[*].minZ = 0m
*.environment.obstacle[*].maxZ = 3m
*.environment.obstacle[0].minX = 5m
*.environment.obstacle[0].maxX = 4m
*.environment.obstacle[0].minY = 5m
*.environment.obstacle[0].maxY = 4m
*.environment.obstacle[1].material = "bricks"
*.environment.obstacle[1].minX = 5s
*.environment.obstacle[2..3].typename = "prism"
*.environment.obstacle[3].points = "0 0 10 0"
"""
    error = folder.mistake(lines)
    assert [each.line for each in error.errors] == [10, 12, 13, 14, 15, 16]
    assert [each.source.part for each in error.errors] == ["", "", "", "", "obstacle[2]", ""]


def test_points_without_a_typename_are_one_error(folder: Any) -> None:
    error = folder.mistake(PRISM.replace('*.environment.obstacle[0].typename = "prism"\n', ""))
    assert not isinstance(error, ConfigErrors)
    assert (error.line, error.key) == (7, "*.environment.obstacle[0].points")


def test_an_obstacle_names_all_that_it_lacks(folder: Any) -> None:
    error = folder.mistake("*.environment.numObstacles = 2\n")
    assert [(each.line, each.source.part) for each in error.errors] == [
        (6, "obstacle[0]"),
        (6, "obstacle[1]"),
    ]
    assert all(f"{end}{axis}" in error.problem for end in ("min", "max") for axis in "XYZ")


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
        [((0, 0), (10, 0), (10, 0), (10, 10), (0, 10))],  # a repeated corner
        [((0, 0), (5, 0), (10, 0), (10, 10), (0, 10))],  # a corner on a straight side
        [((0, 0), (10, 0), (10, 10), (10, 20), (10, 10), (0, 10))],  # back on the same line
        [((0, 0), (5, 5), (10, 0), (10, 10), (5, 5), (0, 10))],  # two triangles that meet in a corner
        [((0, 0), (10, 0), (10, 10), (5, -0.05), (0, 10))],  # within the tolerance
        [
            ((0, 0), (10, 0.05), (10, 10), (0, 10)),
            ((3, 0), (7, 0), (5, 5)),
        ],  # at the wall except for rounding
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
        [SQUARE, ((0, 0), (10, 0), (5, 10))],  # all of its corners are at the wall
        [SQUARE, ((0, 3), (0, 7), (7, 7))],
        [SQUARE, ((-0.05, 3), (-0.05, 7), (7, 7))],  # at the wall except for rounding
        [SQUARE, ((1, 1), (1, 2), (2, 1)), ((2, 1), (1, 2), (2, 2))],  # adjacent courtyards
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
        ([YARD, SQUARE], (1, 0)),  # inner and outer exchanged
        ([U, ((3, 10), (3, 3), (7, 3), (7, 10))], (1, 0)),  # the courtyard is outside of the outer ring
        ([SQUARE, ((5, 5), (10, 4), (12, 5), (10, 6))], (1, 0)),  # leaves through the wall by corners
        ([SQUARE, YARD, ((4, 4), (4, 6), (6, 6))], (2, 1)),
        ([SQUARE, ((4, 4), (4, 6), (6, 6)), YARD], (1, 2)),
        ([SQUARE, YARD, YARD[::-1]], (2, 1)),  # the same again
    ],
)
def test_finds_a_ring_that_is_not_a_courtyard(rings: list[Ring], found: tuple[int, int]) -> None:
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
