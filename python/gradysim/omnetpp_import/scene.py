"""Where geographic positions are in the scene of a configuration."""

import contextlib
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from fnmatch import fnmatchcase
from itertools import chain

from gradysim.protocol.position import Position, geo_to_cartesian
from gradysim.scenario.errors import BadValue
from gradysim.scenario.parse.expressions import parse_value
from gradysim.scenario.parse.ini import Entry, Section
from gradysim.scenario.schema.parameter_types import number_in

PART = re.compile(r"(?:\[[^\]]*\]|\{[^}]*\}|[^.\[{])+")
"""A part of a key; ranges in brackets have dots of their own."""


class Scene:
    """The coordinate systems of a file."""

    def __init__(self, orders: Mapping[str, Sequence[Section]]) -> None:
        """Take the sections in which the lines of each section are looked up, its own one first."""
        entries = {name: own.entries for name, (own, *_) in orders.items()}
        self._groups = {
            group_in(entry.key)
            for entry in chain(*entries.values())
            if entry.key.endswith(".coordinateSystemModule") and entry.text != '""'
        }
        scenes = {
            name: [entry for entry in lines if "coordinateSystem." in entry.key]
            for name, lines in entries.items()
        }
        self._origins: dict[Entry, Position] = {}
        for name, order in orders.items():
            lines = [*chain(*(scenes[each.name] for each in order)), *chain(*scenes.values())]
            origin = _origin(lines)
            self._origins |= dict.fromkeys(entries[name], origin)

    def is_geographic(self, key: str) -> bool:
        """Return whether the nodes of a key have geographic positions."""
        group = group_in(key)
        return group in self._groups or any(
            fnmatchcase(group, each) for each in self._groups if not each.isidentifier()
        )

    def position(self, entry: Entry, latitude: float, longitude: float, altitude: float) -> Position:
        """Return x, y and z in meters of a position in degrees and meters, in the scene of a line.

        Raises BadValue for a latitude beyond a pole, and for an infinite coordinate.
        """
        _check_latitude(latitude)
        if not (math.isfinite(longitude) and math.isfinite(altitude)):
            raise BadValue("it is infinite")
        return geo_to_cartesian(self._origins[entry], (latitude, longitude, altitude))

    def coordinate_m(self, entry: Entry, axis: int, value: float) -> float:
        """Return one coordinate in meters: that of a latitude, a longitude or an altitude.

        Meters per degree of longitude are those at the latitude of the scene. Raises BadValue as `position`.
        """
        origin = self._origins[entry]
        latitude, longitude, altitude = (value if axis == each else origin[each] for each in range(3))
        return self.position(entry, latitude, longitude, altitude)[axis]


def _origin(lines: Sequence[Entry]) -> Position:
    """Return latitude, longitude and altitude of the scene. If a section has none, its heirs may have one."""
    return (
        _first_number(lines, "sceneLatitude", "deg"),
        _first_number(lines, "sceneLongitude", "deg"),
        _first_number(lines, "sceneAltitude", "m"),
    )


def _first_number(lines: Iterable[Entry], parameter: str, unit: str) -> float:
    for entry in lines:
        if entry.key.endswith(f"coordinateSystem.{parameter}"):
            with contextlib.suppress(BadValue):
                number = number_of(unit, entry.text)
                if parameter == "sceneLatitude":
                    _check_latitude(number)
                if math.isfinite(number):
                    return number
    return 0.0


def _check_latitude(latitude: float) -> None:
    if not abs(latitude) <= 90.0:
        raise BadValue(f"a latitude of {latitude:g} degrees; expected one from -90deg to 90deg")


def group_in(key: str) -> str:
    """Return the name below the network in a key, without its index."""
    parts = PART.findall(key)
    return parts[1].partition("[")[0] if len(parts) > 1 else ""


def number_of(unit: str, text: str) -> float:
    """Return a number with or without a unit. Raises BadValue for anything else."""
    return float(number_in(unit).convert(parse_value(text)))
