"""Given paths: where nodes start, where they are, and what is refused."""

import math
from typing import Any

import pytest

from gradysim.protocol.position import Position
from gradysim.scenario.build.paths import LARGEST_GAP_M, Path, path_of
from gradysim.scenario.errors import ConfigError

AREA = "".join(
    f"*.uavs[*].mobility.constraintArea{end} = {value}m\n"
    for end, value in (("MinX", 0), ("MaxX", 100), ("MinY", -10), ("MaxY", 40), ("MinZ", 0), ("MaxZ", 0))
)


def path_in(folder: Any, typename: str, *lines: str) -> Path:
    """Return the path of uavs[0], whose mobility has these lines."""
    mobility = "".join(f"*.uavs[*].mobility.{line}\n" for line in (f'typename = "{typename}"', *lines))
    spec = folder.load(mobility + AREA).nodes[1]
    path = path_of(spec.mobility, spec.initial_position)
    assert path is not None
    assert path(0) == spec.initial_position
    return path


def is_near(place: Position, expected: Position) -> bool:
    return math.dist(place, expected) < 1e-9


def test_a_line_is_reflected_at_the_walls(folder: Any) -> None:
    heading = f"initialMovementHeading = {math.degrees(math.atan2(3, 4))!r}deg"
    path = path_in(folder, "LinearMobility", heading, "initialX = 80m", "speed = 10mps")
    assert is_near(path(2.5), (100, 15, 0))
    assert is_near(path(5), (80, 30, 0))
    assert is_near(path(10), (40, 20, 0))


def test_a_line_climbs(folder: Any) -> None:
    lines = ["initialMovementElevation = 30deg", "speed = 10mps", "constraintAreaMaxZ = 1km"]
    path = path_in(folder, "LinearMobility", *lines)
    assert is_near(path(2), (20 * math.cos(math.pi / 6), 0, 10))


def test_a_circle_is_never_left_by_more_than_its_gap(folder: Any) -> None:
    lines = ["cx = 10m", "cy = 20m", "cz = 30m", "r = 50m", "startAngle = 90deg", "speed = 5mps"]
    path = path_in(folder, "CircleMobility", *lines)
    assert is_near(path(0), (10, 70, 30))
    assert math.dist(path(math.pi * 10), (10, -30, 30)) < LARGEST_GAP_M
    distances = [math.dist(path(time_s / 7), (10, 20, 30)) for time_s in range(1000)]
    assert 50 - LARGEST_GAP_M <= min(distances) < max(distances) <= 50 + 1e-9


def test_a_rectangle_is_the_border_of_the_area(folder: Any) -> None:
    path = path_in(folder, "RectangleMobility", "startPos = 1.5", "initialZ = 7m", "speed = 10mps")
    places = [path(time_s) for time_s in (0, 2.5, 12.5, 17.5, 30)]
    expected = [(100, 15, 7), (100, 40, 7), (0, 40, 7), (0, -10, 7), (100, 15, 7)]
    assert all(map(is_near, places, expected))


def test_an_area_without_extent_is_a_place(folder: Any) -> None:
    lines = ["constraintAreaMaxX = 0m", "constraintAreaMaxY = -10m"]
    assert path_in(folder, "RectangleMobility", *lines)(5) == (0, -10, 0)


@pytest.mark.parametrize(
    ("lines", "problem"),
    [
        (['typename = "CircleMobility"'], "`mobility.r = 100m`"),
        (
            ['typename = "RectangleMobility"', "constraintAreaMinX = 1m", "constraintAreaMaxX = 2m"],
            "constraintAreaMinY and constraintAreaMaxY",
        ),
        (
            ['typename = "LinearMobility"', "constraintAreaMaxX = 7m", "initialX = 8m"],
            "x = 8m; .* 7m",
        ),
        (
            ['typename = "LinearMobility"', "constraintAreaMinY = 9m", "constraintAreaMaxY = 7m"],
            " 7m .* 9m",
        ),
    ],
)
def test_what_is_no_path(folder: Any, lines: list[str], problem: str) -> None:
    with pytest.raises(ConfigError, match=problem):
        folder.load("".join(f"*.uavs[*].mobility.{line}\n" for line in lines))
