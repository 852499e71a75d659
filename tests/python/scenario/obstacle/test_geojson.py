"""Obstacles from GeoJSON files."""

import json
from typing import Any

import pytest

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


def test_properties_of_others_are_none_of_ours(folder: Any) -> None:
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
    ("text", "message"),
    [
        ("{", "line 1 is no JSON"),
        ("[]", "it is no JSON object"),
        ('{"type": "Topology"}', "its type is 'Topology'; expected a FeatureCollection"),
        (town("x"), "feature 0 is no object of type Feature"),
        (town(feature(), crs=None), "nothing says where the scene is"),
        (town(feature("Point", [0, 0])), "feature 0: its geometry is of type 'Point'; expected Polygon"),
        (town(feature(name="Hall")), 'feature 0 ("Hall"): it has no height'),
        (town(feature(), feature(height="high")), "feature 1: its height is 'high'; expected a number"),
        (town(feature(height=10**400)), "its height is inf; expected a number"),
        (town(feature(coordinates=[[[0, 0], [10**400, 1], [1, 1], [0, 0]]])), "is too far away"),
        ("[" * 100_000, "it is nested too deeply"),
        (town(feature(height=-2)), "its height is -2; expected metres, more than 0"),
        (town(feature(height=True)), "its height is True; expected a number"),
        (
            town(feature(height=1, base=1e7)),
            "its base is at 1e+07 m and its roof at 1e+07 m (base and height); expected the roof above",
        ),
        (
            town(feature(height=1e-20, base=3)),
            "its base is at 3 m and its roof at 3 m (base and height); expected the roof above the base",
        ),
        (town(feature(height=3, base=-2e7)), "both at most 10000000 m from z = 0"),
        (town(feature(height=1, material=7)), "its material is 7; expected one of concrete, brick"),
        (town(feature(height=1, material="bricks")), "metal; did you mean `brick`?"),
        (
            town(feature(height=1, relativePermittivity=-1)),
            "its relativePermittivity is -1; expected at least 1",
        ),
        (town(feature(height=1, conductivity="-1")), "its conductivity is -1; expected at least 0"),
        (
            town(feature(), feature(height=1, materail="glass")),
            "feature 1: nothing reads its property `materail`; did you mean `material`?",
        ),
        (town(feature(hieght=3, height=None)), "nothing reads its property `hieght`; did you mean `height`?"),
        (town(feature(coordinates=[])), "it has a polygon without rings"),
        (town(feature(coordinates=[SQUARE[:4]])), "it has a ring that is not closed"),
        (town(feature(coordinates=[[[0, 0], [1, 1], [2, 2], [0, 0]]])), "a ring that encloses nothing"),
        (
            town(feature(coordinates=[[[0, 0], [10, 0], [0, 10], [10, 10], [0, 0]]])),
            "feature 0: the side from [10, 0] to [0, 10] crosses the side from [10, 10] to [0, 0]",
        ),
        (
            town(feature(coordinates=[SQUARE, [[5, 5], [5, 7], [12, 6], [5, 5]]])),
            "the side from [10, 0] to [10, 10] crosses the side from [5, 7] to [12, 6]",
        ),
        (
            town(feature(coordinates=[SQUARE, YARD, [[100, 100], [100, 102], [102, 101], [100, 100]]])),
            "feature 0: the ring from [100, 100] on is not inside of the outer one, the ring from [0, 0] on",
        ),
        (
            town(feature(coordinates=[SQUARE, YARD, [[4, 4], [4, 6], [6, 6], [4, 4]]])),
            "feature 0: the ring from [4, 4] on is inside of the ring from [3, 3] on; expected inner rings",
        ),
        (town(feature(coordinates=[[[0, 0], ["x", 1], [1, 1], [0, 0]]])), "['x', 1] is no position"),
        (town(feature(coordinates=[[[0, 0], [2e7, 1], [1, 1], [0, 0]]])), "is too far away"),
    ],
)
def test_mistakes_name_file_and_feature(folder: Any, text: str, message: str) -> None:
    folder.write("town.geojson", text)
    error = folder.error(LINE)
    assert error.startswith("test.ini:6:")
    assert "town.geojson" in error
    assert message in error


def test_degrees_out_of_range_are_told(folder: Any) -> None:
    folder.write("town.geojson", town(feature(coordinates=[[[0, 0], [0, 95], [1, 1], [0, 0]]]), crs=None))
    error = folder.error(LINE + ON_EARTH)
    assert (
        "[0, 95] is no longitude and latitude in degrees; if they are x and y of the scene in metres" in error
    )


def test_small_numbers_of_metres_are_taken_for_degrees_and_told_as_far_away(folder: Any) -> None:
    folder.write(
        "town.geojson", town(feature(coordinates=[[[40, 0], [170, 50], [41, 1], [40, 0]]]), crs=None)
    )
    error = folder.error(LINE + ON_EARTH)
    assert "[170, 50] is too far away; expected longitude and latitude at most 10000000 m" in error
    assert error.endswith('`"crs": {"type": "name", "properties": {"name": "local"}}` in the file')


def test_a_missing_file_is_told(folder: Any) -> None:
    assert "town.geojson: cannot read it: No such file" in folder.error(LINE)


def test_a_file_that_is_not_utf_8_is_told(folder: Any) -> None:
    (folder.path / "town.geojson").write_text(town(feature(name="Café")).replace(r"\u00e9", "é"), "latin-1")
    assert folder.error(LINE).endswith("town.geojson: it is no text in UTF-8")


def test_a_file_with_nearly_the_name_of_a_missing_one_is_suggested(folder: Any) -> None:
    folder.write("twon.geojson", "")
    assert folder.error(LINE).endswith("No such file or directory; did you mean `twon.geojson`?")
