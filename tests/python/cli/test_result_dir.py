"""`gradysim run --result-dir`: a file for each run."""

import json
import os

import pytest

from gradysim.cli import main


def test_files_of_results_are_written_to_it(gradysim, folder):
    done = gradysim("run", "test.ini", "--mode", "prototype", "-r", "0,2", "--result-dir", "out/here")
    assert sorted(path.name for path in (folder / "out" / "here").iterdir()) == [
        "General-#0.prototype.json",
        "General-#2.prototype.json",
    ]
    assert "General-#2.prototype.json" in done.stdout
    assert json.loads((folder / "out" / "here" / "General-#2.prototype.json").read_text())["run"] == 2


@pytest.mark.parametrize(
    ("name", "reason"),
    [("test.ini", "it is no folder"), ("dangling", "it is no folder"), ("d" * 300, "File name too long")],
)
def test_a_folder_that_cannot_be_is_named_with_its_option(folder, gradysim, name, reason):
    (folder / "dangling").symlink_to("nowhere/at/all")
    done = gradysim("run", "test.ini", "--mode", "prototype", "--result-dir", name)
    expected = f"--result-dir {name}: {reason}; expected a folder, or a new name"
    assert (done.returncode, done.stderr.strip()) == (2, expected)


def test_a_folder_that_takes_no_files_is_told_before_the_runs(folder, monkeypatch, capsys):
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    monkeypatch.chdir(folder)
    assert main(["run", "test.ini", "--mode", "prototype", "--quiet", "--result-dir", "out"]) == 2
    told = "--result-dir out: it takes no files from you; expected another folder\n"
    assert capsys.readouterr() == ("", told)
