"""Keys of where on the earth the origin lies."""

from gradysim.scenario.keys.key import Key
from gradysim.scenario.keys.shapes import Below
from gradysim.scenario.parameter_types import quantity

_own = Below("coordinateSystem", "reference")

COORDINATE_SYSTEM_KEYS: tuple[Key, ...] = (
    _own(
        "sceneLatitude",
        "latitude_deg",
        quantity("deg", at_least=-90, at_most=90),
        "Latitude of the origin, for geographic coordinates",
        default="0deg",
    ),
    _own(
        "sceneLongitude",
        "longitude_deg",
        quantity("deg", at_least=-180, at_most=180),
        "Longitude of the origin",
        default="0deg",
    ),
    _own("sceneAltitude", "altitude_m", quantity("m"), "Altitude of the origin", default="0m"),
)
