"""Failing outputs: a full disk, a reader that has exited, a closed stream."""

import errno
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from gradysim.cli import run
from gradysim.viewer.page import page
from python.cli.command import compiled, disk_of, environment, run_command
from python.thorough import some

FULL_DISK = Path("/dev/full")

QUIET = ["--set", "*.uavs[*].protocol.class=protocol.py:Quiet"]
"""Protocols that print nothing."""

EVERY_COMMAND = pytest.mark.parametrize(
    "arguments",
    [
        ["--help"],
        ["--version"],
        ["keys"],
        ["runs", "test.ini"],  # it ends before its buffer is full
        ["run", "test.ini", "--mode", "prototype", *QUIET],
        ["run", "test.ini", "--mode", "prototype", *QUIET, "--json"],
        pytest.param(["calibrate", "test.ini", "--range", "50m"], marks=compiled),
    ],
)


def run_with_output(folder, output, arguments, **variables):
    """Run the command with a file as its standard output."""
    return subprocess.run(
        [sys.executable, "-m", "gradysim", *arguments],
        cwd=folder,
        env={**environment(), **variables},
        stdout=output,
        stderr=subprocess.PIPE,
        text=True,
        check=False,
    )


@pytest.fixture
def closed_pipe():
    theirs, ours = os.pipe()
    os.close(theirs)
    yield ours
    os.close(ours)


@EVERY_COMMAND
def test_a_reader_that_has_had_enough_ends_it_silently(folder, arguments, closed_pipe):
    if arguments[0] == "run":
        arguments = [*arguments, "-r", "0"]
    done = run_with_output(folder, closed_pipe, arguments)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize(("jobs", "fewest"), [("1", 1), ("2", 2)])
def test_a_reader_that_has_had_enough_ends_a_study_with_a_message(folder, closed_pipe, jobs, fewest):
    arguments = ["run", "test.ini", "--mode", "prototype", *QUIET, "--result-dir", "out"]
    many = ["--set", "repeat=20", "--jobs", jobs]
    done = run_with_output(folder, closed_pipe, [*arguments, *many])
    assert done.returncode == 2
    assert done.stderr.splitlines()[0].endswith(os.strerror(errno.EPIPE))
    assert fewest <= len(list((folder / "out").iterdir())) < 20


@pytest.mark.parametrize("options", [["--result-dir", "out"], ["--result-dir", "out", "--jobs", "2"]])
def test_a_reader_that_leaves_before_the_last_run_loses_nothing(folder, closed_pipe, options):
    arguments = ["run", "test.ini", "--mode", "prototype", *QUIET, "-r", "0", *options]
    assert run_with_output(folder, closed_pipe, arguments).returncode == 0
    assert len(list((folder / "out").iterdir())) == 1


@pytest.mark.skipif(not FULL_DISK.exists(), reason="this system has no disk that is always full")
@pytest.mark.parametrize("buffering", some([{}, {"PYTHONUNBUFFERED": "1"}]), ids=["buffered", "unbuffered"])
@EVERY_COMMAND
def test_a_full_disk_is_told_in_one_line(folder, arguments, buffering):
    with FULL_DISK.open("w") as full:
        done = run_with_output(folder, full, arguments, **buffering)
    assert done.returncode == 2
    assert done.stderr.splitlines()[0].endswith(os.strerror(errno.ENOSPC))


@pytest.mark.skipif(not FULL_DISK.exists(), reason="this system has no disk that is always full")
def test_why_a_protocol_failed_is_told_also_on_a_full_disk(folder):
    with FULL_DISK.open("w") as full:
        done = run_with_output(
            folder, full, ["run", "test.ini", "-c", "Failing", "--mode", "prototype", "--json"]
        )
    assert done.returncode == 2
    assert "spoilt" in done.stderr
    assert os.strerror(errno.ENOSPC) in done.stderr


def test_a_result_that_finds_no_room_is_told_in_one_line(folder):
    arguments = [
        "run",
        "test.ini",
        "--mode",
        "prototype",
        *QUIET,
        "--quiet",
        "--result-dir",
        "out",
        "-r",
        "0",
    ]
    shell = ["sh", "-c", 'ulimit -f 0; exec "$@"', "sh"]
    done = run_command(folder, *shell, sys.executable, "-m", "gradysim", *arguments)
    assert (done.returncode, done.stderr) == (2, "out/General-#0.prototype.json: File too large\n")


ALL_OUTPUTS = ("--result-dir", "out", "--scalars", "--vectors", "all", "--replay", "all", "--pcap", "uavs[0]")


@compiled
def test_each_output_is_synced_before_it_has_its_name(gradysim, folder, monkeypatch):
    fsync = os.fsync
    log = folder / "synced"

    def noted(descriptor):
        fsync(descriptor)
        name = Path(os.readlink(f"/proc/self/fd/{descriptor}")).name
        with log.open("a") as file:  # of the process of the run
            print(name, *sorted(os.listdir(folder / "out")), file=file)

    monkeypatch.setattr(os, "fsync", noted)
    assert gradysim("run", "test.ini", "-r", "0", "--quiet", *ALL_OUTPUTS).returncode == 0
    lines = [line.split() for line in log.read_text().splitlines()]
    for file in (folder / "out").iterdir():
        (at, *_) = [at for at, (name, *_) in enumerate(lines) if name.startswith(f"{file.name}.")]
        _, *there = lines[at]
        assert file.name not in there
        assert lines[at + 1][0] == "out"
        assert file.name in lines[at + 1]


@compiled
@pytest.mark.parametrize("name", ["0.integrated.json", "0.integrated.html", "0-uavs[0].pcap"])
@pytest.mark.parametrize("resume", [[], ["--resume"]])
def test_a_pipe_in_the_place_of_an_output_is_refused(gradysim, folder, name, resume):
    (folder / "out").mkdir()
    os.mkfifo(folder / f"out/General-#{name}")
    done = gradysim("run", "test.ini", "-r", "0", "--quiet", *ALL_OUTPUTS, *resume)
    assert done.returncode == 2
    assert done.stderr.startswith(f"out/General-#{name}: ")
    assert len(list((folder / "out").iterdir())) == 1


@pytest.mark.parametrize(
    "command",
    [["pack", "out", "-o", "to.svg"], ["plot", "out", "--x", "run", "--y", "events", "-o", "to.svg"]],
)
def test_a_pipe_in_the_place_of_a_file_of_another_command_is_refused(gradysim, folder, command):
    gradysim("run", "test.ini", "--mode", "prototype", *QUIET, "--quiet", "--result-dir", "out")
    os.mkfifo(folder / "to.svg")
    done = gradysim(*command)
    assert (done.returncode, done.stderr) == (2, "to.svg: it is a pipe; expected a regular file\n")


@compiled
@pytest.mark.parametrize(
    ("option", "room", "name"),
    [
        ("--replay", 100_000, "General-#0.integrated.html"),
        ("--replay", len(page()) + 5_000, "General-#0.integrated.html"),
        ("--pcap", 10_000, "General-#0-uavs[0].pcap"),
    ],
)
def test_a_capture_or_replay_without_room_is_told_in_one_line(gradysim, folder, option, room, name):
    long = ("--set", "sim-time-limit=300s", "--quiet", "--result-dir", "out")
    with disk_of(room):
        done = gradysim("run", "test.ini", "-r", "0", *long, option, "uavs[0]")
    assert done.returncode == 2
    (line,) = done.stderr.splitlines()
    assert re.search(rf"'out/{re.escape(name)}\.\d+': {os.strerror(errno.EFBIG)}", line)
    (result,) = (folder / "out").iterdir()
    assert json.loads(result.read_text())["interrupted"] is True


@pytest.mark.parametrize("closed", ["1", "2"])
@pytest.mark.parametrize("arguments", [["runs", "test.ini"], ["keys"], ["run", "test.ini", *QUIET, "--json"]])
def test_a_closed_output_is_one_that_nobody_reads(folder, arguments, closed):
    if arguments[0] == "run":
        arguments = [*arguments, "--mode", "prototype"]
    shell = ["sh", "-c", f'exec "$@" {closed}>&-', "sh"]
    done = run_command(folder, *shell, sys.executable, "-m", "gradysim", *arguments)
    assert (done.returncode, done.stderr) == (0, "")
    assert ("Traceback" in done.stdout, bool(done.stdout)) == (False, closed == "2")


def test_a_mistake_is_no_result_where_the_error_output_is_closed(folder):
    done = subprocess.run(
        ["sh", "-c", 'exec "$@" 2>&-', "sh", sys.executable, "-m", "gradysim", "runs", "missing.ini"],
        cwd=folder,
        env=environment(),
        stdout=subprocess.PIPE,
        check=False,
    )
    assert (done.returncode, done.stdout) == (2, b"")


def test_an_error_about_something_else_is_not_told_as_one_of_the_output(gradysim, monkeypatch):
    def fail(*_):
        raise OSError(errno.EAGAIN, "try again")

    monkeypatch.setattr(run, "warnings_of_seeds", fail)
    done = gradysim("run", "test.ini", "--mode", "prototype", "--quiet")
    assert (done.returncode, done.stdout) == (2, "")
    assert "(in fail, " in done.stderr
