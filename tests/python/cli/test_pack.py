"""`gradysim pack`, and the commands that read packs."""

import json
import shutil
import subprocess
import sys

import pytest

from gradysim.cli.errors import LOCKED, MISTAKE
from python.cli.command import environment, objects

RUN = ("run", "test.ini", "--mode", "prototype", "--quiet", "--result-dir", "out")


@pytest.fixture
def packed(gradysim, folder):
    """Run three runs, keep a copy of their files in `loose`, and pack them in `out`."""
    gradysim(*RUN)
    shutil.copytree(folder / "out", folder / "loose")
    done = gradysim("pack", "out", "--remove")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.split()[1] == "3"
    assert [file.name for file in (folder / "out").iterdir()] == ["packs"]
    return folder / "out" / "packs" / "runs.sca"


def test_means_are_those_of_the_files(gradysim, packed):
    means = gradysim("means", "loose").stdout
    assert means == gradysim("means", "out").stdout == gradysim("means", "out/packs/runs.sca").stdout


def test_figures_are_those_of_the_files(gradysim, folder, packed):
    for directory in ("loose", "out"):
        for kind, y in (("line", "uavs[*] said"), ("outcomes", "broadcast frames"), ("cdf", "events")):
            x = () if kind == "cdf" else ("--x", "config")
            file = f"{directory}-{kind}.svg"
            done = gradysim("plot", directory, "--kind", kind, *x, "--y", y, "-o", file)
            assert done.returncode == 0, done.stderr
    for kind in ("line", "outcomes", "cdf"):
        files = [folder / f"{directory}-{kind}" for directory in ("loose", "out")]
        texts = [file.with_suffix(".csv").read_text() for file in files]
        assert texts[0] == texts[1]
        origins = [json.loads(file.with_suffix(".json").read_text()) for file in files]
        hashes = [[run["hash"] for run in origin["runs"]] for origin in origins]
        assert hashes[0] == hashes[1]


def test_packed_runs_are_left_out(gradysim, packed):
    done = gradysim(*RUN, "--resume")
    assert (done.returncode, done.stdout) == (0, "")
    assert "(0..2)" in done.stderr


def test_packed_runs_are_done(gradysim, packed):
    (packed.parent.parent / "General-#1.prototype.json").write_text("{")
    done = gradysim("status", "out", "test.ini", "--mode", "prototype", "--missing")
    assert (done.stdout, done.stderr) == ("1\n", "")


def test_packed_runs_of_other_settings_are_an_error(gradysim, packed):
    done = gradysim(*RUN, "--seed", "5")
    assert done.returncode == MISTAKE
    assert "(0..2)" in done.stderr


def test_a_packed_run_is_replaced(gradysim, packed):
    gradysim(*RUN, "-r", "1", "--replace", "--set", "sim-time-limit=2s")
    assert gradysim("pack", "out").stdout.split()[1] == "1"
    done = gradysim(*RUN, "--resume", "--replace", "--json")
    assert [run["run"] for run in objects(done.stdout)] == [1]


def test_an_edited_protocol_is_noticed(gradysim, folder, packed):
    protocol = folder / "protocol.py"
    protocol.write_text(protocol.read_text().replace('["said"] += 1', '["said"] += 2'))
    done = gradysim(*RUN, "--resume")
    assert all(part in done.stderr for part in (" protocol.py ", "(0..2)"))


def test_the_files_come_back(gradysim, folder, packed):
    done = gradysim("pack", "out", "--unpack", "--remove")
    assert done.stdout.split()[1] == "3"
    before, after = (
        {file.name: file.read_bytes() for file in (folder / name).iterdir()} for name in ("loose", "out")
    )
    assert before == after


def test_files_of_another_pack_are_unpacked(gradysim, folder, packed):
    (folder / "new").mkdir()
    assert gradysim("pack", "new", "-o", "out/packs/runs.sca", "--unpack").returncode == 0
    assert len(list((folder / "new").glob("*.json"))) == 3


def test_a_missing_directory_is_an_error(gradysim):
    done = gradysim("pack", "missing")
    assert done.returncode == MISTAKE
    assert done.stderr.startswith("missing: ")


def test_a_file_that_is_not_a_pack_is_an_error(gradysim):
    for command in ("means", "plot"):
        done = gradysim(command, "test.ini", *(("--y", "events", "-o", "a.svg") if command == "plot" else ()))
        assert done.returncode == MISTAKE
        assert done.stderr.startswith("test.ini: ")


COMPUTES = """
from pathlib import Path
from gradysim.execution.run_lock import run_locked
with run_locked(Path("out"), "General-#0"):
    print("begun", flush=True)
    input()
"""


def test_a_run_in_progress_is_an_error(gradysim, folder):
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    command = [sys.executable, "-c", COMPUTES]
    with subprocess.Popen(command, cwd=folder, env=environment(), text=True, **pipes) as other:
        assert other.stdout.readline() == "begun\n"
        done = gradysim("pack", "out")
        other.kill()
    assert done.returncode == LOCKED
    assert done.stderr.startswith("out: ")
