"""Examples of `gradysim new --example`, in a user's directory."""

import errno
import os
import shlex
import subprocess
import sys

import pytest

from gradysim.cli.app import main
from gradysim.cli.examples import NAMES
from python.cli.command import both_modes, compiled, disk_of, environment


@pytest.fixture(params=NAMES)
def example(request, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "--example", request.param]) == 0
    directory, *printed = capsys.readouterr().out.splitlines()
    assert directory == f"cd {request.param}"
    monkeypatch.chdir(tmp_path / request.param)
    return [shlex.split(command, comments=True) for command in printed]


@both_modes
def test_its_runs_succeed(example, mode):
    runs = [
        [argument for argument in arguments if argument != "--quiet"]
        for arguments in example
        if arguments[:2] == ["gradysim", "run"]
    ]
    assert runs
    for _, *arguments in runs:
        if "--mode" not in arguments:
            settings = ["--mode", mode, "--runs", "0", "--quiet", "--set", "sim-time-limit = 3s"]
            assert main([*arguments, *settings]) == 0


def test_its_files_are_beside_each_other(example, tmp_path):
    (folder,) = tmp_path.iterdir()
    assert (folder / f"{folder.name}.ini").is_file()
    assert {file.parent for file in folder.rglob("*.*") if "__pycache__" not in file.parts} == {folder}


@pytest.mark.verify
@compiled
def test_the_comparison_of_zigzag_runs_in_a_copy(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "zigzag", "--example"]) == 0
    done = subprocess.run(
        [sys.executable, "compare.py", "ZigZag5"],
        cwd="zigzag",
        env=environment(),
        capture_output=True,
        text=True,
        check=True,
    )
    assert "readings" in done.stdout


def test_without_a_name_the_examples_are_listed(capsys):
    assert main(["new", "--example"]) == 0
    assert [line.split()[0] for line in capsys.readouterr().out.splitlines()] == list(NAMES)


def test_a_wrong_name_is_answered_with_the_names(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "--example", "zigzg"]) == 2
    message = capsys.readouterr().err
    assert ", ".join(NAMES) in message
    assert "`zigzag`" in message
    assert list(tmp_path.iterdir()) == []


def test_an_existing_directory_is_left_alone(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "zigzag").mkdir()
    assert main(["new", "--example", "zigzag"]) == 2
    assert "zigzag" in capsys.readouterr().err
    assert list((tmp_path / "zigzag").iterdir()) == []


@pytest.mark.parametrize("arguments", [["zigzag", "--example"], ["zigzag"]])
def test_files_that_cannot_be_written_leave_no_directory(tmp_path, monkeypatch, capsys, arguments):
    monkeypatch.chdir(tmp_path)
    with disk_of(100):
        assert main(["new", *arguments]) == 2
    assert capsys.readouterr().err == f"zigzag: {os.strerror(errno.EFBIG)}\n"
    assert list(tmp_path.iterdir()) == []


def test_a_name_is_required_without_an_example(capsys):
    assert main(["new"]) == 2
    assert "swarm" in capsys.readouterr().err
