"""`gradysim plot`: from the files of `run --result-dir`."""

import csv
import json

import pytest

from python.cli.command import both_modes, run_without

pytest.importorskip("matplotlib", reason="the figures need it")


def rows(file):
    with file.open(encoding="utf-8", newline="") as lines:
        return list(csv.DictReader(lines))


@pytest.fixture
def study(gradysim, folder):
    """Write three runs for each of two time limits in prototype mode, with vectors, to `out`."""
    limits = ("--set", "sim-time-limit=${limit=3, 5}.5s", "--set", "seed-set=${repetition}")
    options = ("--mode", "prototype", "--vectors", "uavs", "--result-dir", "out", "--quiet")
    gradysim("run", "test.ini", *limits, *options)
    return folder


def test_a_line_of_means(gradysim, study):
    done = gradysim("plot", "out", "--x", "limit", "--y", "uavs[*] said", "-o", "said.svg")
    assert (done.returncode, done.stderr) == (0, "")
    assert "said.svg" in done.stdout
    means = gradysim("means", "out", "uavs[*] said", "--csv").stdout.splitlines()
    assert [
        f"General,prototype,{row['limit'].split('.')[0]},uavs[*] said,{row['runs']},{row['mean']}"
        for row in rows(study / "said.csv")
    ] == [line.rsplit(",", 3)[0] for line in means[1:]]
    origin = json.loads((study / "said.json").read_text())
    assert (origin["kind"], origin["x"], origin["y"]) == ("line", "limit", "uavs[*] said")
    assert len(origin["runs"]) == 6


@pytest.mark.parametrize(
    ("kind", "arguments"),
    [
        ("diff", ("--x", "config", "--y", "uavs[*] said", "--by", "limit", "--baseline", "5")),
        ("cdf", ("--y", "broadcast messages delay in s", "--columns", "2", "--log", "y")),
        ("time", ("--y", "uavs[*] said", "--by", "limit")),
        ("outcomes", ("--y", "broadcast frames", "--x", "limit", "--omit", "below sensitivity", "lost")),
        ("map", ("--where", "limit=3", "run=1")),
    ],
)
def test_each_kind(gradysim, study, kind, arguments):
    done = gradysim("plot", "out", "--kind", kind, *arguments, "-o", "figure.svg")
    assert (done.returncode, done.stderr) == (0, "")
    assert (study / "figure.svg").read_text().startswith("<?xml")
    assert rows(study / "figure.csv")
    assert json.loads((study / "figure.json").read_text())["kind"] == kind


def test_only_the_runs_that_are_wanted(gradysim, study):
    gradysim(
        "plot", "out", "--x", "limit", "--y", "events", "--where", "limit=5", "run=3", "run=4", "-o", "f.svg"
    )
    assert [run["run"] for run in json.loads((study / "f.json").read_text())["runs"]] == [3, 4]


def test_runs_without_the_variable_are_left_out(gradysim, study):
    gradysim("run", "test.ini", "--result-dir", "out", "--quiet")
    done = gradysim("plot", "out", "--x", "limit", "--y", "events", "-o", "f.svg")
    assert done.returncode == 0
    assert all(part in done.stderr for part in (" 3 ", "`limit`", "--where config=General"))
    assert {row["limit"] for row in rows(study / "f.csv")} == {"3.0", "5.0"}


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("--x", "limt", "--y", "events"), "did you mean `limit`?"),
        (("--x", "limit", "--y", "uavs said"), "did you mean `uavs[*] said`?"),
        (("--x", "limit"), "--kind line needs --metric"),
        (("--kind", "outcomes"), "expected one of broadcast frames, broadcast messages"),
        (("--kind", "time"), "expected one of uavs[*] said, uavs[*] positionX, "),
        (
            ("--kind", "cdf", "--y", "broadcast messages delay in s", "--log", "x"),
            "--log x: no value on this",
        ),
        (("--x", "limit", "--y", "events", "--where", "limit"), "--where limit: expected VARIABLE=VALUE"),
        (
            ("--x", "limit", "--y", "events", "--where", "limit=4"),
            "no run has limit = 4; expected one of 3, 5",
        ),
    ],
)
def test_mistakes(gradysim, study, arguments, told):
    done = gradysim("plot", "out", *arguments, "-o", "f.svg")
    assert (done.returncode, done.stdout) == (2, "")
    assert told in done.stderr
    assert not (study / "f.svg").exists()


def test_a_folder_without_results(gradysim):
    done = gradysim("plot", ".", "--x", "config", "--y", "events", "-o", "f.svg")
    assert done.returncode == 2
    assert done.stderr.startswith(".: ")


def test_runs_that_are_one_run_are_warned_of(gradysim):
    gradysim(
        "run", "test.ini", "--mode", "prototype", "--result-dir", "out", "--quiet", "--set", "seed-set=5"
    )
    done = gradysim("plot", "out", "--x", "config", "--y", "events", "-o", "f.svg")
    assert done.returncode == 0
    assert " 2 of 3 " in done.stderr


def test_without_matplotlib(study):
    done = run_without("matplotlib", study, "plot", "out", "--x", "limit", "--y", "events", "-o", "f.svg")
    assert (done.returncode, done.stdout) == (2, "")
    assert "pip" in done.stderr


@both_modes
def test_delays_of_both_modes(gradysim, folder, mode):
    gradysim("run", "test.ini", "--mode", mode, "--result-dir", "out", "--quiet")
    gradysim("plot", "out", "--kind", "cdf", "--y", "broadcast messages delay in s", "-o", "f.svg")
    shares = [float(row["mean"]) for row in rows(folder / "f.csv")]
    assert shares == sorted(shares)
    assert shares[-1] == 1
