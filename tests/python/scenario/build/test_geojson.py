"""Obstacles from GeoJSON files."""

import json
from typing import Any

import pytest

from gradysim.scenario.errors import ConfigError

SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]]
YARD = [[3, 3], [3, 7], [7, 7], [7, 3], [3, 3]]
LOCAL = {"type": "name", "properties": {"name": "local"}}
LINE = '*.environment.obstacles = "town.geojson"\n'
ON_EARTH = "*.coordinateSystem.sceneLatitude = -15deg\n*.coordinateSystem.sceneLongitude = -48deg\n"


def feature(
    kind: str = "Polygon", coordinates: object = (SQUARE,), **properties: object
) -> dict[str, object]:
    return {
        "type": "Feature",
        "properties": properties or {"height": 12},
        "geometry": {"type": kind, "coordinates": coordinates},
    }


def town(*features: object, **members: object) -> str:
    return json.dumps({"type": "FeatureCollection", "features": features, "crs": LOCAL, **members})


def error_of(folder: Any, content: str | None, added: str = "") -> ConfigError:
    """Return the error of a scenario with that file, which is always reported at the line that names it."""
    if content is not None:
        folder.write("town.geojson", content)
    with pytest.raises(ConfigError) as error:
        folder.load(LINE + added)
    assert error.value.line == 6
    return error.value


def test_a_polygon_with_a_courtyard(folder: Any) -> None:
    folder.write(
        "town.geojson", town(feature(coordinates=[SQUARE, YARD], height=12, base=3, material="brick"))
    )
    (obstacle,) = folder.load(LINE).obstacles
    assert obstacle.rings == (
        ((0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)),
        ((3.0, 3.0), (3.0, 7.0), (7.0, 7.0), (7.0, 3.0)),
    )
    assert (obstacle.base_m, obstacle.top_m, obstacle.material) == (3.0, 15.0, "brick")
    assert (obstacle.name, obstacle.source.line) == ("town.geojson, feature 0", 6)


def test_each_polygon_of_several_is_an_obstacle(folder: Any) -> None:
    folder.write(
        "town.geojson", town(feature(), feature("MultiPolygon", [[SQUARE], [YARD]], height="7.5", name="B"))
    )
    obstacles = folder.load(LINE).obstacles
    assert [obstacle.top_m for obstacle in obstacles] == [12.0, 7.5, 7.5]
    assert obstacles[1].name == 'town.geojson, feature 1 ("B")'


def test_longitude_and_latitude_are_placed_by_the_reference(folder: Any) -> None:
    ring = [[-48, -15], [-48, -14.999], [-47.999, -14.999], [-48, -15]]
    folder.write("town.geojson", town(feature(coordinates=[ring]), crs=None))
    (obstacle,) = folder.load(LINE + ON_EARTH).obstacles
    north_m, east_m = 111.194927, 107.406000
    xs, ys = zip(*obstacle.rings[0], strict=True)
    assert xs == pytest.approx((0, north_m, north_m), abs=1e-3)
    assert ys == pytest.approx((0, 0, east_m), abs=1e-3)


def test_a_byte_order_mark_is_stripped(folder: Any) -> None:
    folder.write("town.geojson", "\ufeff" + town(feature()))
    assert len(folder.load(LINE).obstacles) == 1


def test_a_material_of_its_own(folder: Any) -> None:
    folder.write("town.geojson", town(feature(height=3, relativePermittivity=4, conductivity="0.1")))
    (obstacle,) = folder.load(LINE).obstacles
    assert (obstacle.relative_permittivity, obstacle.conductivity_spm) == (4.0, 0.1)


def test_the_least_of_a_material(folder: Any) -> None:
    folder.write("town.geojson", town(feature(height=3, relativePermittivity=1, conductivity=0)))
    (obstacle,) = folder.load(LINE).obstacles
    assert (obstacle.relative_permittivity, obstacle.conductivity_spm) == (1.0, 0.0)


def test_they_follow_those_of_the_ini_file(folder: Any) -> None:
    folder.write("town.geojson", town(feature()))
    own = "*.environment.numObstacles = 1\n*.environment.obstacle[0].minZ = 0m\n"
    own += '*.environment.obstacle[0].maxZ = 9m\n*.environment.obstacle[0].typename = "prism"\n'
    own += '*.environment.obstacle[0].points = "0 0 1 0 1 1"\n'
    assert [obstacle.top_m for obstacle in folder.load(own + LINE).obstacles] == [9.0, 12.0]


def test_other_properties_are_ignored(folder: Any) -> None:
    of_map = {
        "building": "yes",
        "building:material": "brick",
        "min_height": "3",
        "weight": 2,
        "materials": "glass",
    }
    folder.write("town.geojson", town(feature(height=3, material="wood", old_name="A", **of_map)))
    (obstacle,) = folder.load(LINE).obstacles
    assert (obstacle.base_m, obstacle.material) == (0.0, "wood")


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("{", "line 1"),
        ("[]", "object"),
        ('{"type": "Topology"}', "'Topology'"),
        (town("x"), "feature 0"),
        (town(feature(), crs=None), "sceneLatitude"),
        (town(feature("Point", [0, 0])), "'Point'"),
        (town(feature(name="Hall")), 'feature 0 ("Hall"): '),
        (town(feature(), feature(height="high")), "feature 1: its height is 'high'"),
        (town(feature(height=10**400)), " inf"),
        (town(feature(coordinates=[[[0, 0], [10**400, 1], [1, 1], [0, 0]]])), "away"),
        ("[" * 100_000, "nested"),
        (town(feature(height=-2)), " -2"),
        (town(feature(height=True)), " True"),
        (town(feature(height=1, base=1e7)), "roof at 1e+07 m"),
        (town(feature(height=1e-20, base=3)), "roof at 3 m"),
        (town(feature(height=3, base=-2e7)), " -2e+07 m"),
        (town(feature(height=1, material=7)), " 7"),
        (town(feature(height=1, material="bricks")), "`brick`"),
        (town(feature(height=1, relativePermittivity=-1)), "relativePermittivity"),
        (town(feature(height=1, conductivity="-1")), "conductivity"),
        (town(feature(), feature(height=1, materail="glass")), "feature 1: "),
        (town(feature(height=1, materail="glass")), "`material`"),
        (town(feature(hieght=3, height=None)), "`height`"),
        (town(feature(coordinates=[])), "rings"),
        (town(feature(coordinates=[SQUARE[:4]])), "closed"),
        (town(feature(coordinates=[[[0, 0], [1, 1], [2, 2], [0, 0]]])), "encloses"),
        (
            town(feature(coordinates=[[[0, 0], [10, 0], [0, 10], [10, 10], [0, 0]]])),
            "from [10, 10] to [0, 0]",
        ),
        (
            town(feature(coordinates=[SQUARE, [[5, 5], [5, 7], [12, 6], [5, 5]]])),
            "from [5, 7] to [12, 6]",
        ),
        (
            town(feature(coordinates=[SQUARE, YARD, [[100, 100], [100, 102], [102, 101], [100, 100]]])),
            "[100, 100]",
        ),
        (
            town(feature(coordinates=[SQUARE, YARD, [[4, 4], [4, 6], [6, 6], [4, 4]]])),
            "[3, 3]",
        ),
        (town(feature(coordinates=[[[0, 0], ["x", 1], [1, 1], [0, 0]]])), "['x', 1]"),
        (town(feature(coordinates=[[[0, 0], [2e7, 1], [1, 1], [0, 0]]])), "[20000000.0, 1]"),
    ],
)
def test_an_error_names_file_and_feature(folder: Any, text: str, names: str) -> None:
    error = error_of(folder, text)
    assert "town.geojson" in error.message
    assert names in error.message


def test_degrees_out_of_range_are_refused(folder: Any) -> None:
    text = town(feature(coordinates=[[[0, 0], [0, 95], [1, 1], [0, 0]]]), crs=None)
    assert "[0, 95]" in error_of(folder, text, ON_EARTH).message


def test_numbers_of_meters_that_could_be_degrees_are_refused_with_a_hint(folder: Any) -> None:
    text = town(feature(coordinates=[[[40, 0], [170, 50], [41, 1], [40, 0]]]), crs=None)
    message = error_of(folder, text, ON_EARTH).message
    assert "[170, 50]" in message
    assert '"name": "local"' in message


def test_a_missing_file_is_refused(folder: Any) -> None:
    assert "town.geojson" in error_of(folder, None).message


def test_a_file_that_is_not_utf_8_is_refused(folder: Any) -> None:
    (folder.path / "town.geojson").write_text(town(feature(name="Café")).replace(r"\u00e9", "é"), "latin-1")
    assert "UTF-8" in error_of(folder, None).message


def test_a_file_with_nearly_the_name_of_a_missing_one_is_suggested(folder: Any) -> None:
    folder.write("twon.geojson", "")
    assert "`twon.geojson`" in error_of(folder, None).message


def test_all_wrong_features_are_reported_at_once(folder: Any) -> None:
    error = error_of(folder, town(feature(height=-1), feature(), feature("Point")))
    assert [each.source.part for each in error.errors] == [  # type: ignore[attr-defined]
        "town.geojson, feature 0",
        "town.geojson, feature 2",
    ]
