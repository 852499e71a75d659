"""Obstacles: how .ini files describe them, and the checks of their outlines."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

from gradysim.protocol.position import LARGEST_COORDINATE_M, rotate_position_2d
from gradysim.scenario.errors import ConfigError, ErrorCollector, Source
from gradysim.scenario.obstacle_spec import Corner, ObstacleSpec, Ring
from gradysim.scenario.resolve.lines import read_struct
from gradysim.scenario.resolve.resolution import Resolution
from gradysim.scenario.schema.engine_keys import HAS_TO_BE_GIVEN
from gradysim.scenario.schema.keys import DEFAULT_MATERIAL, NUM_OBSTACLES, OBSTACLE_KEYS, obstacle_path
from gradysim.scenario.schema.values import Setting, SettingReader

Side = tuple[int, int]
"""A side of an outline: the number of its ring and of the corner where it begins."""

_TOUCH_M = 0.1
"""Sides that overlap by no more than this only touch.

It is a unit of the sixth decimal of a degree. GeoJSON files mostly have no more decimals (RFC 7946, section
11.2), so rounding moves a courtyard at a wall this far.
"""

_BOX_ONLY = ("min_x", "max_x", "min_y", "max_y", "heading_rad")


def read_obstacles(
    resolution: Resolution, settings: SettingReader, errors: ErrorCollector
) -> tuple[ObstacleSpec, ...]:
    """Return the obstacles that the .ini file describes. `errors` takes what is missing or wrong."""
    rows = resolution.of_network
    obstacles = []
    for index in range(resolution.obstacle_count):
        paths = (obstacle_path(key, index) for key in OBSTACLE_KEYS)
        wrong = ErrorCollector()
        values = read_struct("obstacle", (rows[path] for path in paths if path in rows), settings, wrong)
        counted_at = rows[NUM_OBSTACLES.path].line.entry.source
        source = next((setting.source for setting in values.values()), counted_at)
        with errors.collecting():
            wrong.raise_all()
            obstacles.append(_obstacle(f"obstacle[{index}]", values, source))
    return tuple(obstacles)


def _obstacle(name: str, values: Mapping[str, Setting], source: Source) -> ObstacleSpec:
    is_box = "typename" not in values or values["typename"].value == "box"
    errors = ErrorCollector()
    idle: tuple[str, ...] = ("points",)
    why = 'only a prism has points; expected `typename = "prism"`'
    if not is_box:
        idle, why = _BOX_ONLY, 'a prism has points; expected `typename = "box"`, or points'
    for name_of_field in idle:
        if name_of_field in values:
            errors.add(ConfigError.at(values[name_of_field].source, f"{name}: {why}"))
    needed = [key for key in OBSTACLE_KEYS if key.default == HAS_TO_BE_GIVEN and key.field not in idle]
    missing = [key.path.rpartition(".")[2] for key in needed if key.field not in values]
    if missing and not errors.errors:  # after a wrong typename, all of the others would be missing
        example = '"0 0 10 0 10 5"' if missing[0] == "points" else "10m"
        problem = f"{name} has no {', '.join(missing)}"
        expected = f"`*.environment.{name}.{missing[0]} = {example}`"
        errors.add(ConfigError(problem, replace(source, part=name), expected=expected))
    for axis in "xyz" if is_box else "z":
        low, high = values.get(f"min_{axis}"), values.get(f"max_{axis}")
        if low and high and not float(low.value) < float(high.value):
            text = f"expected more than min{axis.upper()}, {low.value:g}m"
            errors.add(ConfigError.at(high.source, text))
    errors.raise_all()
    own: dict[str, Any] = {
        property_name: float(values[property_name].value)
        for property_name in ("relative_permittivity", "conductivity_spm")
        if property_name in values
    }
    return ObstacleSpec(
        name,
        (_box(values) if is_box else _prism(values["points"]),),
        float(values["min_z"].value),
        float(values["max_z"].value),
        source,
        str(values["material"].value) if "material" in values else DEFAULT_MATERIAL,
        **own,
        sources={f"obstacle.{target}": setting.source for target, setting in values.items()},
    )


def _box(values: Mapping[str, Setting]) -> Ring:
    west, east, south, north = (float(values[field].value) for field in ("min_x", "max_x", "min_y", "max_y"))
    corners = ((west, south), (east, south), (east, north), (west, north))
    heading = values.get("heading_rad")
    if heading is None or heading.value == 0:
        return corners
    x, y = (west + east) / 2, (south + north) / 2
    turned = [
        rotate_position_2d((corner[0] - x, corner[1] - y, 0.0), math.degrees(float(heading.value)))
        for corner in corners
    ]
    ring = tuple((x + dx, y + dy) for dx, dy, _ in turned)
    _check_within_scene(ring, heading.source)
    return ring


def _prism(points: Setting) -> Ring:
    try:
        numbers = [float(word) for word in str(points.value).split()]
    except ValueError:
        numbers = []
    if len(numbers) < 6 or len(numbers) % 2 or not all(map(math.isfinite, numbers)):
        text = 'expected x and y in meters for at least 3 corners: "0 0 10 0 10 5"'
        raise ConfigError.at(points.source, text)
    ring = tuple(zip(numbers[::2], numbers[1::2], strict=True))
    _check_within_scene(ring, points.source)
    if encloses_nothing(ring):
        raise ConfigError.at(points.source, "expected corners that are not on one line")
    if crossing := crossing_sides([ring]):
        one, other = (
            "from ({:g}, {:g}) to ({:g}, {:g})".format(*ring[corner], *ring[(corner + 1) % len(ring)])
            for _, corner in crossing
        )
        text = f"the side {one} crosses the side {other}; expected corners in their order around the obstacle"
        raise ConfigError.at(points.source, text)
    return ring


def _check_within_scene(ring: Ring, source: Source) -> None:
    for x, y in ring:
        if max(abs(x), abs(y)) > LARGEST_COORDINATE_M:
            text = f"the corner ({x:g}, {y:g}) is too far away"
            raise ConfigError.at(source, f"{text}; expected x and y of at most {LARGEST_COORDINATE_M} m")


def encloses_nothing(ring: Ring) -> bool:
    """Return whether all corners lie on one line."""
    (x, y), *others = ring
    offsets = [(other_x - x, other_y - y) for other_x, other_y in others]
    dx, dy = max(offsets, key=lambda offset: math.hypot(*offset))
    return all(dx * offset_y == dy * offset_x for offset_x, offset_y in offsets)


def crossing_sides(rings: Sequence[Ring]) -> tuple[Side, Side] | None:
    """Return two sides of one outline that cross; None if none do.

    Sides that touch do not cross: those of a courtyard at the wall, or those around a repeated corner.
    """
    sides = [
        (min(begin[0], end[0]), max(begin[0], end[0]), begin, end, (ring, corner))
        for ring, corners in enumerate(rings)
        for corner, (begin, end) in enumerate(zip(corners, (*corners[1:], corners[0]), strict=True))
    ]
    sides.sort(key=lambda side: side[0])
    for index, (_, highest_x, begin, end, one) in enumerate(sides, start=1):
        for lowest_x, _, other_begin, other_end, other in sides[index:]:
            if lowest_x > highest_x:
                break
            if sides_cross(begin, end, other_begin, other_end):
                return min(one, other), max(one, other)
    return None


def sides_cross(begin: Corner, end: Corner, other_begin: Corner, other_end: Corner) -> bool:
    """Return whether two sides reach beyond each other."""
    return _are_apart(begin, end, other_begin, other_end) and _are_apart(other_begin, other_end, begin, end)


def _are_apart(begin: Corner, end: Corner, one: Corner, other: Corner) -> bool:
    """Return whether the line through `begin` and `end` passes between the two other corners."""
    dx, dy = end[0] - begin[0], end[1] - begin[1]
    least = _TOUCH_M * math.hypot(dx, dy)
    of_one = dx * (one[1] - begin[1]) - dy * (one[0] - begin[0])
    of_other = dx * (other[1] - begin[1]) - dy * (other[0] - begin[0])
    return (of_one > least and of_other < -least) or (of_one < -least and of_other > least)


def misplaced_ring(rings: Sequence[Ring]) -> tuple[int, int] | None:
    """Return an inner ring that is not within the first ring, or that is within another inner ring.

    The pair holds its number and that of the other ring. None if all rings are where they belong. The sides
    of the rings must not cross. They may touch.
    """
    samples = [[*ring, _point_within(ring)] for ring in rings]
    spans = [(min(ring)[0], max(ring)[0]) for ring in rings]  # in x
    for inner in range(1, len(rings)):
        if any(_depth_m(point, rings[0]) < -_TOUCH_M for point in samples[inner]):
            return inner, 0
        for other in range(1, inner):
            if spans[inner][1] < spans[other][0] or spans[other][1] < spans[inner][0]:
                continue
            for within, around in ((inner, other), (other, inner)):
                if any(_depth_m(point, rings[around]) > _TOUCH_M for point in samples[within]):
                    return within, around
    return None


def _depth_m(point: Corner, ring: Ring) -> float:
    """Return the distance of a point to a ring: positive inside of it, negative outside."""
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
    """Return a point inside of a ring and far from its sides: the middle of a long stretch at one y."""
    heights = sorted({y for _, y in ring})
    low, high = max(pairwise(heights), key=lambda pair: pair[1] - pair[0])
    y = (low + high) / 2
    xs = sorted(
        begin[0] + (end[0] - begin[0]) * (y - begin[1]) / (end[1] - begin[1])
        for begin, end in zip(ring, (*ring[1:], ring[0]), strict=True)
        if (begin[1] > y) != (end[1] > y)
    )
    stretches = zip(xs[::2], xs[1::2], strict=True)
    # A ring that is thinner than the resolution of a float has no such stretch.
    west, east = max(stretches, key=lambda pair: pair[1] - pair[0], default=(ring[0][0], ring[0][0]))
    return (west + east) / 2, y
