"""Obstacles from a GeoJSON file (RFC 7946): each polygon is a body with vertical walls.

Properties of a feature: `height` in metres from floor to roof; `base`, the height of the floor above z = 0,
0 if missing; `material`, `relativePermittivity` and `conductivity` as in an .ini file; `name`, for messages.
Others are ignored, unless they look like one of these that is missing. Coordinates are longitude and latitude
in degrees, as RFC 7946 has it, and are placed in the scene by `coordinateSystem.sceneLatitude` and
`sceneLongitude`; or they are x and y of the scene in m, if the file says so:
`"crs": {"type": "name", "properties": {"name": "local"}}`.
"""

import json
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from gradysim.protocol.position import LARGEST_COORDINATE_M, Position, geo_to_cartesian
from gradysim.scenario.errors import ConfigError, Source, did_you_mean, nearest, nearest_file
from gradysim.scenario.keys.environment import DEFAULT_MATERIAL, MATERIALS, OBSTACLE_FILE
from gradysim.scenario.obstacle.obstacle_spec import ObstacleSpec
from gradysim.scenario.obstacle.outline import Ring, crossing_sides, encloses_nothing, misplaced_ring

LOCAL_CRS = "local"

_IF_IN_METRES = (
    "if they are x and y of the scene in metres, expected"
    ' `"crs": {"type": "name", "properties": {"name": "local"}}` in the file'
)

Placing = Callable[[float, float], tuple[float, float]]
"""What turns the two numbers of a position into x and y in metres."""

_PROPERTIES = ("height", "base", "material", "relativePermittivity", "conductivity")
"""Those that matter: a misspelt `name` hurts nobody, and there are many like it."""

_NUMBERS = {"relativePermittivity": ("relative_permittivity", 1), "conductivity": ("conductivity_spm", 0)}
"""{property: (its field, the least)}."""
_MOST_DIGITS = 300


class _BadFileError(Exception):
    """What is wrong with the file, or a feature of it."""


def read_geojson(path: str, source: Source, reference: Position | None) -> list[ObstacleSpec]:
    """The obstacles of a file, seen from the file of `source`, which is where errors are reported.

    `reference` is the origin's (latitude deg, longitude deg, altitude m), if the configuration gives it.
    Raises ConfigError, which names file and feature.
    """
    file = source.file.parent / path
    try:
        content = _parse(file)
        features = _features(content)
        place = _placing(content, reference)
        obstacles: list[ObstacleSpec] = []
        for index, feature in enumerate(features):
            name = f"{path}, feature {index}"
            properties = feature.get("properties")
            properties = properties if isinstance(properties, dict) else {}
            if isinstance(properties.get("name"), str):
                name += f' ("{properties["name"]}")'
            try:
                obstacles += _obstacles(name, feature.get("geometry"), properties, place, source)
            except _BadFileError as error:
                raise ConfigError.at(source, f"{name}: {error}") from error
    except _BadFileError as error:
        raise ConfigError.at(source, f"{path}: {error}") from error
    return obstacles


def _parse(file: Path) -> Mapping[str, Any]:
    try:
        content = json.loads(file.read_text(encoding="utf-8-sig"), parse_int=_whole_number)
    except OSError as error:
        match = nearest_file(file, (".geojson", ".json"))
        hint = f"; did you mean `{match}`?" if match else ""
        raise _BadFileError(f"cannot read it: {error.strerror or error}{hint}") from error
    except UnicodeDecodeError as error:
        raise _BadFileError("it is no text in UTF-8") from error
    except json.JSONDecodeError as error:
        raise _BadFileError(f"line {error.lineno} is no JSON: {error.msg}") from error
    except RecursionError as error:
        raise _BadFileError("it is nested too deeply; expected a FeatureCollection") from error
    if not isinstance(content, dict):
        raise _BadFileError("it is no JSON object; expected a FeatureCollection")
    return content


def _whole_number(digits: str) -> int | float:
    """The number; infinity in place of what no double can hold, which is refused like one."""
    return int(digits) if len(digits) < _MOST_DIGITS else float(digits)


def _features(content: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    features = content.get("features")
    if content.get("type") == "Feature":
        features = [content]
    elif content.get("type") != "FeatureCollection" or not isinstance(features, list):
        raise _BadFileError(
            f"its type is {content.get('type')!r}; expected a FeatureCollection with features"
        )
    for index, feature in enumerate(features):
        if not isinstance(feature, dict) or feature.get("type") != "Feature":
            raise _BadFileError(f"feature {index} is no object of type Feature")
    return features


def _placing(content: Mapping[str, Any], reference: Position | None) -> Placing:
    """By the coordinates that the file says it has."""
    crs = content.get("crs")
    properties = crs.get("properties") if isinstance(crs, dict) else None
    name = properties.get("name") if isinstance(properties, dict) else None
    if name == LOCAL_CRS:
        return lambda x, y: (x, y)
    if reference is None:
        raise _BadFileError(
            "its coordinates are longitude and latitude, and nothing says where the scene is; expected "
            "`*.coordinateSystem.sceneLatitude = ...deg` and `sceneLongitude`; " + _IF_IN_METRES
        )

    def place(longitude: float, latitude: float) -> tuple[float, float]:
        if abs(longitude) > 180 or abs(latitude) > 90:
            raise _BadFileError(
                f"[{longitude:g}, {latitude:g}] is no longitude and latitude in degrees; {_IF_IN_METRES}"
            )
        x, y, _ = geo_to_cartesian(reference, (latitude, longitude, reference[2]))
        if not _is_in_the_scene(x, y):
            raise _BadFileError(
                f"[{longitude:g}, {latitude:g}] is too far away; expected longitude and latitude at most"
                f" {LARGEST_COORDINATE_M} m from the origin; {_IF_IN_METRES}"
            )
        return x, y

    return place


def _obstacles(
    name: str,
    geometry: object,
    properties: Mapping[str, Any],
    place: Placing,
    source: Source,
) -> list[ObstacleSpec]:
    kind = geometry.get("type") if isinstance(geometry, dict) else None
    coordinates = geometry.get("coordinates") if isinstance(geometry, dict) else None
    if kind == "Polygon":
        polygons = [coordinates]
    elif kind == "MultiPolygon" and isinstance(coordinates, list):
        polygons = coordinates
    else:
        raise _BadFileError(f"its geometry is of type {kind!r}; expected Polygon or MultiPolygon")
    _refuse_misspelt(properties)
    height_m = _number(properties, "height")
    base_m = _number(properties, "base", 0.0)
    top_m = base_m + height_m
    if height_m <= 0:
        raise _BadFileError(f"its height is {height_m:g}; expected metres, more than 0")
    if not -LARGEST_COORDINATE_M <= base_m < top_m <= LARGEST_COORDINATE_M:
        raise _BadFileError(
            f"its base is at {base_m:g} m and its roof at {top_m:g} m (base and height); expected the roof"
            f" above the base, both at most {LARGEST_COORDINATE_M} m from z = 0"
        )
    material = properties.get("material", DEFAULT_MATERIAL)
    if material not in MATERIALS:
        hint = did_you_mean(material, MATERIALS) if isinstance(material, str) else ""
        raise _BadFileError(f"its material is {material!r}; expected one of {', '.join(MATERIALS)}{hint}")
    own: dict[str, float] = {}
    for key, (field, least) in _NUMBERS.items():
        if properties.get(key) is not None:
            own[field] = number = _number(properties, key)
            if number < least:
                raise _BadFileError(f"its {key} is {number:g}; expected at least {least}")
    sources = {OBSTACLE_FILE.target: source}
    return [
        ObstacleSpec(
            name,
            _rings(polygon, place),
            base_m,
            top_m,
            source,
            material,
            **own,
            sources=sources,
        )
        for polygon in polygons
    ]


def _refuse_misspelt(properties: Mapping[str, Any]) -> None:
    """A property that looks like one of ours is another one only where ours stands beside it."""
    missing = [name for name in _PROPERTIES if properties.get(name) is None]
    for name in properties:
        if name not in _PROPERTIES and (meant := nearest(name, missing, strict=True)):
            raise _BadFileError(f"nothing reads its property `{name}`; did you mean `{meant}`?")


def _number(properties: Mapping[str, Any], key: str, default: float | None = None) -> float:
    """A property; as in exports of OpenStreetMap it may be a text."""
    value = properties.get(key)
    if value is None:
        if default is None:
            raise _BadFileError(f"it has no {key}; expected a number of metres among its properties")
        return default
    try:
        number = math.nan if isinstance(value, bool) else float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise _BadFileError(f"its {key} is {value!r}; expected a number")
    return number


def _rings(polygon: object, place: Placing) -> tuple[Ring, ...]:
    if not isinstance(polygon, list) or not polygon:
        raise _BadFileError("it has a polygon without rings")
    rings = tuple(_ring(ring, place) for ring in polygon)
    if crossing := crossing_sides(rings):
        one, other = (f"from {polygon[ring][at]} to {polygon[ring][at + 1]}" for ring, at in crossing)
        raise _BadFileError(
            f"the side {one} crosses the side {other}; expected the positions of each ring in their order"
            " around it, and inner rings inside of the outer one"
        )
    if misplaced := misplaced_ring(rings):
        inner, other = (f"the ring from {polygon[ring][0]} on" for ring in misplaced)
        where = "inside of" if misplaced[1] else "not inside of the outer one,"
        raise _BadFileError(
            f"{inner} is {where} {other}; expected inner rings, its courtyards, inside of the outer one and"
            " not of each other (another body is another polygon of a MultiPolygon)"
        )
    return rings


def _ring(ring: object, place: Placing) -> Ring:
    if not isinstance(ring, list) or len(ring) < 4 or ring[0] != ring[-1]:
        raise _BadFileError(
            "it has a ring that is not closed: expected at least 4 positions, the last as the first"
        )
    corners = tuple(_corner(position, place) for position in ring[:-1])
    if encloses_nothing(corners):
        raise _BadFileError("it has a ring that encloses nothing: expected corners that are not on one line")
    return corners


def _corner(position: object, place: Placing) -> tuple[float, float]:
    if (
        not isinstance(position, Sequence)
        or len(position) < 2
        or not all(
            isinstance(number, int | float) and not isinstance(number, bool) for number in position[:2]
        )
    ):
        raise _BadFileError(f"{position!r} is no position; expected two numbers")
    x, y = place(float(position[0]), float(position[1]))
    if not _is_in_the_scene(x, y):
        raise _BadFileError(
            f"{position!r} is too far away; expected at most {LARGEST_COORDINATE_M} m from the origin"
        )
    return x, y


def _is_in_the_scene(x: float, y: float) -> bool:
    return abs(x) <= LARGEST_COORDINATE_M and abs(y) <= LARGEST_COORDINATE_M
