import csv
import errno
import json
import os
import sys
from pathlib import Path

import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

import gradysim
from gradysim.plots import new_figure, save_figure
from gradysim.plots.figure import COLORS
from gradysim.results import Runs
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.resolve.runs import hash_of
from python.cli.command import disk_of

HEARD = "uavs[*] heard"
BEGINNINGS = {".pdf": b"%PDF", ".png": b"\x89PNG", ".svg": b"<?xml"}


@pytest.mark.parametrize("suffix", BEGINNINGS)
def test_a_picture_its_numbers_and_their_origin(tmp_path: Path, study: Runs, suffix: str) -> None:
    path = tmp_path / "new" / f"heard{suffix}"
    written = save_figure(path, study, x="jitter", y=HEARD)
    assert written == (path, tmp_path / "new/heard.csv", tmp_path / "new/heard.json")
    assert path.read_bytes().startswith(BEGINNINGS[suffix])


def test_the_numbers_are_those_of_the_figure(tmp_path: Path, study: Runs) -> None:
    _, numbers, _ = save_figure(tmp_path / "f.svg", study, x="jitter", y=HEARD)
    with numbers.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == ["mode", "jitter (ms)", "runs", "mean", "low", "high"]
    assert [(row["mode"], float(row["jitter (ms)"]), float(row["mean"])) for row in rows] == [
        ("integrated", 1, 12),
        ("integrated", 2, 61 / 3),
        ("prototype", 1, 10),
        ("prototype", 2, 20),
    ]


def test_the_origin_names_what_was_asked_for_and_the_files(tmp_path: Path, study: Runs) -> None:
    some = study.where(mode="prototype")
    _, _, origin = save_figure(tmp_path / "f.svg", some, kind="cdf", y="cpu_s", by=["jitter"], log=["x"])
    told = json.loads(origin.read_text())
    runs = told.pop("runs")
    assert told == {
        "figure": "f.svg",
        "numbers": "f.csv",
        "gradysim": gradysim.__version__,
        "kind": "cdf",
        "y": "cpu_s",
        "by": ["jitter"],
        "log": ["x"],
    }
    first = next(iter(some))
    assert len(runs) == 6
    assert runs[0] == {
        "file": str(first.file),
        "hash": hash_of(first.file),
        "config": "Study",
        "mode": "prototype",
        "run": 0,
        "seed": 0,
        "settings_hash": "a",
    }


@pytest.mark.parametrize("suffix", BEGINNINGS)
def test_equal_numbers_make_equal_files(tmp_path: Path, study: Runs, suffix: str) -> None:
    files = [tmp_path / f"{name}{suffix}" for name in ("one", "two")]
    one, two = (save_figure(file, study, x="jitter", y=HEARD)[0].read_bytes() for file in files)
    assert one == two


@pytest.mark.parametrize("name", ["f.jpg", "f", ".svg"])
def test_a_name_that_is_not_that_of_a_picture(tmp_path: Path, study: Runs, name: str) -> None:
    with pytest.raises(ConfigError) as raised:
        save_figure(tmp_path / name, study, x="jitter", y=HEARD)
    assert raised.value.expected == ".pdf, .png, .svg"


def test_no_result_is_replaced(study: Runs) -> None:
    result = next(iter(study)).file
    before = result.read_bytes()
    with pytest.raises(ConfigError):
        save_figure(result.with_suffix(".png"), study, x="jitter", y=HEARD)
    assert result.read_bytes() == before


@pytest.mark.parametrize(
    ("kind", "arguments"),
    [("line", {"y": HEARD}), ("line", {"x": "jitter"}), ("cdf", {}), ("outcomes", {}), ("time", {})],
)
def test_an_argument_that_is_missing(
    tmp_path: Path, study: Runs, kind: str, arguments: dict[str, str]
) -> None:
    with pytest.raises(ConfigError, match=f"--kind {kind} needs --"):
        save_figure(tmp_path / "f.svg", study, kind=kind, **arguments)


@pytest.mark.parametrize("kind", ["cdf", "time", "map"])
def test_an_argument_too_many(tmp_path: Path, study: Runs, kind: str) -> None:
    arguments = {"x": "jitter"} | ({} if kind == "map" else {"y": HEARD})
    with pytest.raises(ConfigError, match=f"--kind {kind} .* --x"):
        save_figure(tmp_path / "f.svg", study, kind=kind, **arguments)


@pytest.mark.parametrize(("columns", "width_in"), [(1, 3.5), (2, 7.16)])
def test_the_width_of_columns(columns: int, width_in: float) -> None:
    figure = new_figure(columns)
    assert isinstance(figure, Figure)
    assert figure.get_figwidth() == width_in


def test_a_missing_matplotlib_is_named_with_its_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(ImportError, match="`plot`"):
        new_figure()


def test_a_full_disk_names_the_file(tmp_path: Path, study: Runs) -> None:
    with disk_of(1000), pytest.raises(OSError, match=os.strerror(errno.EFBIG)) as raised:
        save_figure(tmp_path / "f.svg", study, x="jitter", y=HEARD)
    assert raised.value.filename == str(tmp_path / "f.svg")
    assert not list(tmp_path.glob("f.*"))


def luminance(color: str) -> float:
    """Return the relative luminance, 0 to 1, by WCAG 2.2."""
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in to_rgb(color)]
    return sum(weight * c for weight, c in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def test_the_first_colors_stand_out_on_paper() -> None:
    assert all(luminance(color) < 0.5 for color in COLORS)
    assert len(set(COLORS)) == len(COLORS)
