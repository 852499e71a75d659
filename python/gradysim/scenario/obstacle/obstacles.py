"""Reads the obstacles of a configuration: those of its own, and those of its GeoJSON file."""

import math
from collections.abc import Mapping
from pathlib import Path

from gradysim.protocol.position import LARGEST_COORDINATE_M, Position, rotate_position_2d
from gradysim.scenario.errors import ConfigError, Source
from gradysim.scenario.keys.environment import (
    DEFAULT_MATERIAL,
    NUM_OBSTACLES,
    OBSTACLE_FILE,
    OBSTACLE_KEYS,
    obstacle_path,
)
from gradysim.scenario.keys.key import Key
from gradysim.scenario.matching.lookup import Lookup
from gradysim.scenario.obstacle.geojson import read_geojson
from gradysim.scenario.obstacle.obstacle_spec import ObstacleSpec
from gradysim.scenario.obstacle.outline import Ring, crossing_sides, encloses_nothing
from gradysim.scenario.value.setting import Setting, SettingReader

_BOX_ONLY = ("min_x", "max_x", "min_y", "max_y", "heading_rad")


def obstacle_count(lookup: Lookup, settings: SettingReader) -> int:
    """How many obstacles the configuration says itself."""
    setting = _setting(lookup, settings, NUM_OBSTACLES, NUM_OBSTACLES.path)
    return int(setting.value) if setting else 0


def obstacle_files(lookup: Lookup, settings: SettingReader) -> list[Path]:
    """The file that has obstacles, if the configuration names one."""
    setting = _setting(lookup, settings, OBSTACLE_FILE, OBSTACLE_FILE.path)
    return [setting.source.file.parent / str(setting.value)] if setting else []


def read_obstacles(
    lookup: Lookup, settings: SettingReader, reference: Position | None
) -> tuple[ObstacleSpec, ...]:
    """All obstacles. `reference` is the origin's latitude, longitude and altitude, if they are given.

    Raises ConfigError for an obstacle that lacks something, and for a file that is not as it has to be.
    """
    count = obstacle_count(lookup, settings)
    size_source = _source_of_count(lookup)
    obstacles = []
    for index in range(count):
        values = {
            key.field: setting
            for key in OBSTACLE_KEYS
            if (setting := _setting(lookup, settings, key, obstacle_path(key, index)))
        }
        obstacles.append(_obstacle(f"obstacle[{index}]", values, size_source))
    file = _setting(lookup, settings, OBSTACLE_FILE, OBSTACLE_FILE.path)
    if file is not None:
        obstacles += read_geojson(str(file.value), file.source, reference)
    return tuple(obstacles)


def _setting(lookup: Lookup, settings: SettingReader, key: Key, path: str) -> Setting | None:
    found = lookup.first(*path.split(".", 1))
    return None if found is None or found.is_default else settings.setting(found.entry, key.kind, path)


def _source_of_count(lookup: Lookup) -> Source | None:
    found = lookup.first(*NUM_OBSTACLES.path.split(".", 1))
    return found.entry.source if found else None


def _obstacle(name: str, values: Mapping[str, Setting], size_source: Source | None) -> ObstacleSpec:
    source = next(iter(values.values())).source if values else size_source
    assert source is not None

    def number(field: str, key: str) -> float:
        if field not in values:
            raise ConfigError(f"{name} has no {key}; expected `*.environment.{name}.{key} = 10m`", source)
        return float(values[field].value)

    base_m, top_m = number("min_z", "minZ"), number("max_z", "maxZ")
    if not base_m < top_m:
        raise ConfigError.at(values["max_z"].source, f"expected more than minZ, {base_m:g}m")
    is_box = "typename" not in values or values["typename"].value == "box"
    if is_box:
        _refuse(name, values, ("points",), 'only a prism has points; expected `typename = "prism"`')
        low = (number("min_x", "minX"), number("min_y", "minY"))
        high = (number("max_x", "maxX"), number("max_y", "maxY"))
        for axis in (0, 1):
            if not low[axis] < high[axis]:
                least = f"more than min{'XY'[axis]}, {low[axis]:g}m"
                raise ConfigError.at(values[f"max_{'xy'[axis]}"].source, f"expected {least}")
        heading = values.get("heading_rad")
        ring = _turned_box(low, high, float(heading.value) if heading else 0.0)
        if heading:
            _check_within_scene(ring, heading.source)
    else:
        _refuse(name, values, _BOX_ONLY, 'a prism has points; expected `typename = "box"`, or points')
        if "points" not in values:
            expected = f'`*.environment.{name}.points = "0 0 10 0 10 5"`'
            raise ConfigError(f"{name} has no points; expected {expected}", source)
        ring = _corners(values["points"])
    own = {
        field: float(values[field].value)
        for field in ("relative_permittivity", "conductivity_spm")
        if field in values
    }
    material = str(values["material"].value) if "material" in values else DEFAULT_MATERIAL
    sources = {f"obstacle.{field}": setting.source for field, setting in values.items()}
    return ObstacleSpec(name, (ring,), base_m, top_m, source, material, **own, sources=sources)


def _refuse(name: str, values: Mapping[str, Setting], fields: tuple[str, ...], why: str) -> None:
    for field in fields:
        if field in values:
            raise ConfigError.at(values[field].source, f"{name}: {why}")


def _turned_box(low: tuple[float, float], high: tuple[float, float], heading_rad: float) -> Ring:
    corners = ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1]))
    if heading_rad == 0:
        return corners
    middle = ((low[0] + high[0]) / 2, (low[1] + high[1]) / 2)
    ring = []
    for x, y in corners:
        turned = rotate_position_2d((x - middle[0], y - middle[1], 0.0), math.degrees(heading_rad))
        ring.append((middle[0] + turned[0], middle[1] + turned[1]))
    return tuple(ring)


def _corners(points: Setting) -> Ring:
    words = str(points.value).split()
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        numbers = []
    if len(numbers) < 6 or len(numbers) % 2 or not all(map(math.isfinite, numbers)):
        text = 'expected x and y in metres for at least 3 corners: "0 0 10 0 10 5"'
        raise ConfigError.at(points.source, text)
    ring = tuple(zip(numbers[::2], numbers[1::2], strict=True))
    _check_within_scene(ring, points.source)
    if encloses_nothing(ring):
        raise ConfigError.at(points.source, "expected corners that are not on one line")
    if crossing := crossing_sides([ring]):
        one, other = (_side(ring, corner) for _, corner in crossing)
        text = f"the side {one} crosses the side {other}; expected corners in their order around the obstacle"
        raise ConfigError.at(points.source, text)
    return ring


def _check_within_scene(ring: Ring, source: Source) -> None:
    for x, y in ring:
        if max(abs(x), abs(y)) > LARGEST_COORDINATE_M:
            text = f"the corner ({x:g}, {y:g}) is too far away"
            raise ConfigError.at(source, f"{text}; expected x and y of at most {LARGEST_COORDINATE_M} m")


def _side(ring: Ring, corner: int) -> str:
    begin, end = ring[corner], ring[(corner + 1) % len(ring)]
    return f"from ({begin[0]:g}, {begin[1]:g}) to ({end[0]:g}, {end[1]:g})"
