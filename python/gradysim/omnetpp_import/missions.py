"""Reads missions of ground stations: files of waypoints in the format QGC WPL."""

from collections.abc import Callable
from pathlib import Path

from gradysim.protocol.position import Position
from gradysim.showcases.mission import BACK

_HEADING = "QGC WPL"
_COLUMNS = 12
_WAYPOINT, _BACK = 16, 120
"""Commands. The second one is GrADyS' own."""


def read_mission(file: Path, to_position: Callable[[float, float, float], Position]) -> str:
    """Return a mission as `FlyingProtocol.mission` has it. `to_position` converts coordinates of the file.

    Raises:
        ValueError: The file cannot be read, or it has more than waypoints and the way back.
    """
    try:
        heading, *rows = file.read_text(encoding="utf-8").splitlines()
    except (OSError, ValueError) as error:  # an empty file has no heading
        raise ValueError(f"{file} cannot be read: {error}") from error
    if not heading.startswith(_HEADING):
        raise ValueError(f"{file} does not begin with {_HEADING}")
    parts: list[str] = []
    for number, row in enumerate(rows, start=2):
        if not (columns := row.split()):
            continue
        try:
            _, _, _, command, hold, _, _, _, *coordinates, _ = map(float, columns)
            latitude, longitude, altitude = coordinates
        except ValueError:
            raise ValueError(f"{file}:{number}: expected {_COLUMNS} numbers") from None
        if BACK in parts or command not in (_WAYPOINT, _BACK) or hold:
            expected = f"expected {_WAYPOINT} without a hold time, or {_BACK} at the end"
            raise ValueError(f"{file}:{number}: command {command:g} is not translated; {expected}")
        parts.append(BACK if command == _BACK else _written(to_position(latitude, longitude, altitude)))
    return ", ".join(parts)


def _written(position: Position) -> str:
    return " ".join(f"{round(coordinate, 2) + 0.0:.10g}" for coordinate in position)
