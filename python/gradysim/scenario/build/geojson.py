"""Obstacles from a GeoJSON file (RFC 7946). Each polygon is a body with vertical walls.

Properties of a feature:

* `height`: from floor to roof, in meters;
* `base`: height of the floor above z = 0, in meters, 0 if missing;
* `material`, `relativePermittivity`, `conductivity`: as in an .ini file;
* `name`: for messages.

Other properties are ignored, unless they look like a missing one of these. Coordinates are longitude and
latitude in degrees (RFC 7946, section 4). `coordinateSystem.sceneLatitude` and `sceneLongitude` place them in
the scene. They are x and y of the scene in meters if the file says
`"crs": {"type": "name", "properties": {"name": "local"}}`.
"""

import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from gradysim.protocol.position import LARGEST_COORDINATE_M, Position, geo_to_cartesian
from gradysim.scenario.build.obstacles import crossing_sides, encloses_nothing, misplaced_ring
from gradysim.scenario.errors import (
    BadValue,
    ConfigError,
    ErrorCollector,
    Source,
    did_you_mean,
    nearest,
    nearest_file,
)
from gradysim.scenario.obstacle_spec import Corner, ObstacleSpec, Ring
from gradysim.scenario.parse.regular_files import check_regular
from gradysim.scenario.resolve.lines import Row
from gradysim.scenario.schema.keys import DEFAULT_MATERIAL, MATERIALS, OBSTACLE_FILE
from gradysim.scenario.schema.values import SettingReader

_IF_IN_METERS = (
    "if they are x and y of the scene in meters, expected"
    ' `"crs": {"type": "name", "properties": {"name": "local"}}` in the file'
)

_PROPERTIES = ("height", "base", "material", "relativePermittivity", "conductivity")

_NUMBERS = {"relativePermittivity": ("relative_permittivity", 1), "conductivity": ("conductivity_spm", 0)}
"""{property: (field, least value)}."""

_MOST_DIGITS = 300
"""Integers with more digits may not fit into a double."""

_Placing = Callable[[float, float], Corner]
"""Turns the two numbers of a position into x and y in meters."""


class _BadGeojsonError(ValueError):
    """What is wrong with the file or with one of its features."""


def read_obstacle_files(
    row: Row | None, settings: SettingReader, reference: Position | None
) -> dict[Path, tuple[ObstacleSpec, ...]]:
    """Return the obstacles of the file that `environment.obstacles` names, by file; {} if it names none.

    Args:
        row: The row of that parameter.
        settings: Reads its value.
        reference: Latitude and longitude (degrees) and altitude (m) of the origin, if the scenario has them.

    Raises:
        ConfigError: The file is missing, or features of it are wrong; all of these are reported.
    """
    if row is None or row.line.is_default:
        return {}
    setting = settings.setting(row.line.entry, row.key.kind, row.path)
    path, source = str(setting.value), setting.source
    file = source.file.parent / path
    try:
        check_regular(file, path)
        content = _parse(file)
        features = _features(content)
        place = _placing(content, reference)
    except BadValue as error:
        raise error.at(source) from error
    except _BadGeojsonError as error:
        raise ConfigError.at(source, f"{path}: {error}") from error
    errors = ErrorCollector()
    obstacles: list[ObstacleSpec] = []
    for index, feature in enumerate(features):
        properties = feature.get("properties")
        properties = properties if isinstance(properties, dict) else {}
        name = properties.get("name")
        where = f"{path}, feature {index}" + (f' ("{name}")' if isinstance(name, str) else "")
        try:
            obstacles += _obstacles(where, feature.get("geometry"), properties, place, source)
        except _BadGeojsonError as error:
            errors.add(ConfigError.at(replace(source, part=where), f"{where}: {error}"))
    errors.raise_all()
    return {file: tuple(obstacles)}


def _parse(file: Path) -> Mapping[str, Any]:
    try:
        content = json.loads(file.read_text(encoding="utf-8-sig"), parse_int=_integer)
    except OSError as error:
        match = nearest_file(file, (".geojson", ".json"))
        hint = f"; did you mean `{match}`?" if match else ""
        raise _BadGeojsonError(f"cannot read it: {error.strerror or error}{hint}") from error
    except UnicodeDecodeError as error:
        raise _BadGeojsonError("it is not UTF-8 text") from error
    except json.JSONDecodeError as error:
        raise _BadGeojsonError(f"line {error.lineno} is not JSON: {error.msg}") from error
    except RecursionError as error:
        raise _BadGeojsonError("it is nested too deeply; expected a FeatureCollection") from error
    if not isinstance(content, dict):
        raise _BadGeojsonError("it is not a JSON object; expected a FeatureCollection")
    return content


def _integer(digits: str) -> int | float:
    """Return the number; infinity for one that no double can hold, which later checks reject."""
    return int(digits) if len(digits) < _MOST_DIGITS else float(digits)


def _features(content: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    features = content.get("features")
    if content.get("type") == "Feature":
        features = [content]
    elif content.get("type") != "FeatureCollection" or not isinstance(features, list):
        raise _BadGeojsonError(
            f"its type is {content.get('type')!r}; expected a FeatureCollection with features"
        )
    for index, feature in enumerate(features):
        if not isinstance(feature, dict) or feature.get("type") != "Feature":
            raise _BadGeojsonError(f"feature {index} is not an object of type Feature")
    return features


def _placing(content: Mapping[str, Any], reference: Position | None) -> _Placing:
    """Return the conversion for the coordinate system that the file declares."""
    crs = content.get("crs")
    properties = crs.get("properties") if isinstance(crs, dict) else None
    if isinstance(properties, dict) and properties.get("name") == "local":
        return lambda x, y: (x, y)
    if reference is None:
        raise _BadGeojsonError(
            "its coordinates are longitude and latitude, and nothing says where the scene is; expected "
            "`*.coordinateSystem.sceneLatitude = ...deg` and `sceneLongitude`; " + _IF_IN_METERS
        )

    def place(longitude: float, latitude: float) -> Corner:
        if abs(longitude) > 180 or abs(latitude) > 90:
            raise _BadGeojsonError(
                f"[{longitude:g}, {latitude:g}] is not a longitude and latitude in degrees; {_IF_IN_METERS}"
            )
        x, y, _ = geo_to_cartesian(reference, (latitude, longitude, reference[2]))
        if not _is_in_the_scene(x, y):
            raise _BadGeojsonError(
                f"[{longitude:g}, {latitude:g}] is too far away; expected longitude and latitude at most"
                f" {LARGEST_COORDINATE_M} m from the origin; {_IF_IN_METERS}"
            )
        return x, y

    return place


def _obstacles(
    name: str, geometry: object, properties: Mapping[str, Any], place: _Placing, source: Source
) -> list[ObstacleSpec]:
    kind = geometry.get("type") if isinstance(geometry, dict) else None
    coordinates = geometry.get("coordinates") if isinstance(geometry, dict) else None
    if kind == "Polygon":
        polygons = [coordinates]
    elif kind == "MultiPolygon" and isinstance(coordinates, list):
        polygons = coordinates
    else:
        raise _BadGeojsonError(f"its geometry is of type {kind!r}; expected Polygon or MultiPolygon")
    _refuse_misspelt(properties)
    base_m, top_m = _floor_and_roof(properties)
    material = properties.get("material", DEFAULT_MATERIAL)
    if material not in MATERIALS:
        hint = did_you_mean(material, MATERIALS) if isinstance(material, str) else ""
        raise _BadGeojsonError(f"its material is {material!r}; expected one of {', '.join(MATERIALS)}{hint}")
    own: dict[str, float] = {}
    for key, (field, least) in _NUMBERS.items():
        if properties.get(key) is not None:
            own[field] = _number(properties, key)
            if own[field] < least:
                raise _BadGeojsonError(f"its {key} is {own[field]:g}; expected at least {least}")
    sources = {OBSTACLE_FILE.target: source}
    label = properties.get("name")
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
            label=label if isinstance(label, str) else "",
        )
        for polygon in polygons
    ]


def _refuse_misspelt(properties: Mapping[str, Any]) -> None:
    """Reject a property whose name is similar to a missing one."""
    missing = [name for name in _PROPERTIES if properties.get(name) is None]
    for name in properties:
        if name not in _PROPERTIES and (meant := nearest(name, missing, strict=True)):
            raise _BadGeojsonError(f"nothing reads its property `{name}`; did you mean `{meant}`?")


def _floor_and_roof(properties: Mapping[str, Any]) -> tuple[float, float]:
    """Return z of floor and roof, in meters."""
    height_m = _number(properties, "height")
    base_m = _number(properties, "base", 0.0)
    top_m = base_m + height_m
    if height_m <= 0:
        raise _BadGeojsonError(f"its height is {height_m:g}; expected meters, more than 0")
    if not -LARGEST_COORDINATE_M <= base_m < top_m <= LARGEST_COORDINATE_M:
        raise _BadGeojsonError(
            f"its base is at {base_m:g} m and its roof at {top_m:g} m (base and height); expected the roof"
            f" above the base, both at most {LARGEST_COORDINATE_M} m from z = 0"
        )
    return base_m, top_m


def _number(properties: Mapping[str, Any], key: str, default: float | None = None) -> float:
    """Return a property. It may be a string, as in exports of OpenStreetMap."""
    value = properties.get(key)
    if value is None:
        if default is None:
            raise _BadGeojsonError(f"it has no {key}; expected a number of meters among its properties")
        return default
    try:
        number = math.nan if isinstance(value, bool) else float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise _BadGeojsonError(f"its {key} is {value!r}; expected a number")
    return number


def _rings(polygon: object, place: _Placing) -> tuple[Ring, ...]:
    if not isinstance(polygon, list) or not polygon:
        raise _BadGeojsonError("it has a polygon without rings")
    rings = tuple(_ring(ring, place) for ring in polygon)
    if crossing := crossing_sides(rings):
        one, other = (f"from {polygon[ring][at]} to {polygon[ring][at + 1]}" for ring, at in crossing)
        raise _BadGeojsonError(
            f"the side {one} crosses the side {other}; expected the positions of each ring in their order"
            " around it, and inner rings inside of the outer one"
        )
    if misplaced := misplaced_ring(rings):
        inner, other = (f"the ring from {polygon[ring][0]} on" for ring in misplaced)
        where = "inside of" if misplaced[1] else "not inside of the outer one,"
        raise _BadGeojsonError(
            f"{inner} is {where} {other}; expected inner rings, its courtyards, inside of the outer one and"
            " not of each other (another body is another polygon of a MultiPolygon)"
        )
    return rings


def _ring(ring: object, place: _Placing) -> Ring:
    if not isinstance(ring, list) or len(ring) < 4 or ring[0] != ring[-1]:
        raise _BadGeojsonError(
            "it has a ring that is not closed: expected at least 4 positions, the last as the first"
        )
    corners = tuple(_corner(position, place) for position in ring[:-1])
    if encloses_nothing(corners):
        raise _BadGeojsonError(
            "it has a ring that encloses nothing: expected corners that are not on one line"
        )
    return corners


def _corner(position: object, place: _Placing) -> Corner:
    numbers = position[:2] if isinstance(position, Sequence) else ()
    if len(numbers) < 2 or not all(type(number) in (int, float) for number in numbers):
        raise _BadGeojsonError(f"{position!r} is not a position; expected two numbers")
    x, y = place(float(numbers[0]), float(numbers[1]))
    if not _is_in_the_scene(x, y):
        raise _BadGeojsonError(
            f"{position!r} is too far away; expected at most {LARGEST_COORDINATE_M} m from the origin"
        )
    return x, y


def _is_in_the_scene(x: float, y: float) -> bool:
    return abs(x) <= LARGEST_COORDINATE_M and abs(y) <= LARGEST_COORDINATE_M
