from pathlib import Path

import pytest
from matplotlib.axes import Axes

from gradysim import plots
from gradysim.plots.map import map_numbers
from gradysim.results import Runs, runs
from gradysim.scenario.errors import ConfigError
from python.study_files import write_result, write_vectors


def track(directory: Path, *points: tuple[float, float]) -> Runs:
    """Return a run with one flying node, with a point each second, and one stationary node."""
    file = write_result(directory)
    coordinates = [dict(enumerate(axis)) for axis in zip(*points, strict=True)] + [
        dict.fromkeys(range(len(points)), 5.0)
    ]
    names = [("uavs[0]", "mobility", f"position{axis}") for axis in "XYZ"]
    write_vectors(file, dict(zip(names, coordinates, strict=True)))
    return runs(directory)


def test_corners_of_a_trajectory(tmp_path: Path) -> None:
    study = track(tmp_path, (0, 0), (1, 0), (2, 0), (2, 1), (2, 1), (2, 3), (2, 2))
    flown, standing = map_numbers(study).curves
    assert flown.columns == {
        "x_m": [0, 2, 2, 2],
        "y_m": [0, 0, 3, 2],
        "z_m": [5, 5, 5, 5],
        "time_s": [0, 2, 5, 6],
    }
    assert standing.values == {"node": "uavs[1]"}
    assert standing.columns == {"x_m": [10], "y_m": [0], "z_m": [5], "time_s": [10]}


def test_a_curve_keeps_its_shape(tmp_path: Path) -> None:
    points = [(t * 1.0, t * t / 100) for t in range(100)]
    kept = map_numbers(track(tmp_path, *points)).curves[0]
    assert 10 < len(kept.x) < 60
    assert (kept.x[0], kept.x[-1]) == (0, 99)


def test_a_single_point(tmp_path: Path) -> None:
    assert map_numbers(track(tmp_path, (3, 4))).curves[0].columns["x_m"] == [3]


def test_the_first_run(tmp_path: Path) -> None:
    track(tmp_path, (0, 0), (1, 0))
    write_result(tmp_path, 1)
    assert map_numbers(runs(tmp_path)).caption == "Study-#0, integrated mode, seed 0"


def test_runs_without_positions(tmp_path: Path) -> None:
    write_result(tmp_path)
    with pytest.raises(ConfigError) as raised:
        map_numbers(runs(tmp_path))
    assert "--vectors" in raised.value.expected


def test_what_is_drawn(axes: Axes, tmp_path: Path) -> None:
    assert plots.map(axes, track(tmp_path, (0, 0), (20, 0), (20, 30))) is axes
    flown, end, standing = axes.lines
    assert flown.get_xydata().tolist() == [[0, 0], [20, 0], [20, 30]]
    assert end.get_xydata().tolist() == [[20, 30]]
    assert standing.get_xydata().tolist() == [[10, 0]]
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["uavs[0]", "uavs[*]"]
    assert axes.get_aspect() == 1
