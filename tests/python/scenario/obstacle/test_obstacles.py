"""Obstacles that an .ini file says itself."""

from typing import Any

import pytest

from gradysim.scenario.obstacle.obstacle_spec import ObstacleSpec

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


def test_several_share_what_a_pattern_says(folder: Any) -> None:
    added = PRISM.replace("numObstacles = 1", "numObstacles = 2").replace("obstacle[0]", "obstacle[*]")
    assert [obstacle.name for obstacle in folder.load(added).obstacles] == ["obstacle[0]", "obstacle[1]"]


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        (BOX.replace("*.environment.obstacle[0].maxY = 5m\n", ""), 7, "obstacle[0] has no maxY"),
        (BOX.replace("maxX = 10m", "maxX = -1m"), 8, "expected more than minX, 0m"),
        (BOX.replace("maxZ = 20m", "maxZ = 1m"), 12, "expected more than minZ, 1m"),
        (BOX + '*.environment.obstacle[0].points = "0 0 1 0 1 1"\n', 13, "only a prism has points"),
        (
            PRISM.replace('*.environment.obstacle[0].points = "0 0 10 0 10 5.5"\n', ""),
            7,
            "obstacle[0] has no points",
        ),
        (PRISM.replace("10 5.5", "10"), 8, "x and y in metres for at least 3 corners"),
        (PRISM.replace("10 5.5", "10 north"), 8, "x and y in metres for at least 3 corners"),
        (PRISM.replace("10 5.5", "20 0"), 8, "expected corners that are not on one line"),
        (
            PRISM.replace("10 0 10 5.5", "10 0 0 10 10 10"),
            8,
            "the side from (10, 0) to (0, 10) crosses the side from (10, 10) to (0, 0)",
        ),
        (
            PRISM.replace("10 0", "20000000 0"),
            8,
            "the corner (2e+07, 0) is too far away; expected x and y of at most 10000000 m",
        ),
        (
            BOX.replace("maxX = 10m", "maxX = 10000km").replace("maxY = 5m", "maxY = 10000km")
            + "*.environment.obstacle[0].heading = 45deg\n",
            13,
            "heading = 45deg: the corner (1.20711e+07, 5e+06) is too far away",
        ),
        (PRISM + "*.environment.obstacle[0].heading = 90deg\n", 11, "a prism has points"),
        (BOX + '*.environment.obstacle[0].material = "bricks"\n', 13, "brick"),
        (BOX + "*.environment.obstacle[0].minx = 5m\n", 13, "did you mean"),
        (BOX.replace("numObstacles = 1", "numObstacles = 0"), 7, "that `*.environment.numObstacles` counts"),
        (BOX + "*.environment.obstacle[1].minX = 5m\n", 13, "that `*.environment.numObstacles` counts"),
        ("*.environment.numObstacle = 1\n", 6, "*.environment.numObstacles"),
    ],
)
def test_mistakes_are_told_where_they_are(folder: Any, text: str, line: int, message: str) -> None:
    error = folder.error(text)
    assert error.startswith(f"test.ini:{line}:")
    assert message in error
