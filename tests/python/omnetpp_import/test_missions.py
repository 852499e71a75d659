"""Files of waypoints."""

from pathlib import Path

import pytest

from gradysim.omnetpp_import.missions import read_mission
from gradysim.protocol.position import Position

HEADING = "QGC WPL 110\n"
WAYPOINT = "1\t0\t3\t16\t0.0\t0\t0\t0\t1.5\t-2.25 \t20\t1\n"
BACK = "2\t0\t3\t120\t0\t0\t0\t0\t0\t0\t0\t1\n"


def doubled(*coordinates: float) -> Position:
    x, y, z = (2 * coordinate for coordinate in coordinates)
    return x, y, z


@pytest.mark.parametrize(
    ("text", "mission"),
    [
        (HEADING, ""),
        (HEADING + WAYPOINT, "3 -4.5 40"),
        (HEADING + 2 * WAYPOINT + BACK + "\n", "3 -4.5 40, 3 -4.5 40, back"),
        (HEADING + WAYPOINT.replace("1.5", "123456.789"), "246913.58 -4.5 40"),
    ],
)
def test_missions(tmp_path: Path, text: str, mission: str) -> None:
    (tmp_path / "m").write_text(text)
    assert read_mission(tmp_path / "m", doubled) == mission


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("", "/m"),
        ("1 2 3\n", "QGC WPL$"),
        (HEADING + "1 2 3\n", ":2: .* 12 "),
        (HEADING + WAYPOINT.replace("16", "177"), ":2: command 177"),
        (HEADING + WAYPOINT.replace("0.0", "5"), ":2: command 16"),
        (HEADING + BACK + WAYPOINT, ":3: command 16"),
    ],
)
def test_what_is_not_translated(tmp_path: Path, text: str, problem: str) -> None:
    (tmp_path / "m").write_text(text)
    with pytest.raises(ValueError, match=problem):
        read_mission(tmp_path / "m", doubled)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="missing"):
        read_mission(tmp_path / "missing", doubled)
