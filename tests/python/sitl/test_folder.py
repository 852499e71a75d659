"""The folder of a fleet's files, and what becomes of it when its owner is killed."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from gradysim.sitl.folder import FleetFolder

OWNER = """
import sys
from gradysim.sitl.folder import FleetFolder
folder = FleetFolder()
(folder.path / "0").mkdir()
(folder.path / "0" / "log").write_text("flying")
print(folder.path, flush=True)
sys.stdin.read()
"""


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))


@pytest.fixture
def owner(tmp_path):
    """Another process with a folder, and that folder."""
    process = subprocess.Popen(
        [sys.executable, "-c", OWNER],
        env={**os.environ, "TMPDIR": str(tmp_path), "PYTHONPATH": os.pathsep.join(sys.path)},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    with process:
        yield process, Path(process.stdout.readline().strip())
        process.kill()


def folders(tmp_path):
    return sorted(tmp_path.glob("gradysim-sitl-*"))


def test_it_is_there_until_it_is_removed(tmp_path):
    folder = FleetFolder()
    assert folders(tmp_path) == [folder.path]
    folder.remove()
    folder.remove()
    assert folders(tmp_path) == []


def test_that_of_an_owner_who_was_killed_is_removed_by_the_next(owner, tmp_path):
    process, theirs = owner
    process.kill()
    process.wait()
    assert (theirs / "0" / "log").exists()
    ours = FleetFolder()
    assert folders(tmp_path) == [ours.path]
    ours.remove()


def test_that_of_an_owner_who_lives_stays(owner, tmp_path):
    _, theirs = owner
    ours, other = FleetFolder(), FleetFolder()
    assert folders(tmp_path) == sorted([theirs, ours.path, other.path])
    ours.remove()
    other.remove()


def test_what_has_no_lock_stays(tmp_path):
    (tmp_path / "gradysim-sitl-mine").mkdir()
    (tmp_path / "gradysim-sitl-file").write_text("")
    FleetFolder().remove()
    assert [folder.name for folder in folders(tmp_path)] == ["gradysim-sitl-file", "gradysim-sitl-mine"]


def test_that_of_another_user_stays(owner, tmp_path, monkeypatch):
    process, theirs = owner
    process.kill()
    process.wait()
    monkeypatch.setattr("os.geteuid", lambda: theirs.stat().st_uid + 1)
    FleetFolder().remove()
    assert folders(tmp_path) == [theirs]


def test_a_link_to_a_folder_elsewhere_is_not_followed(owner, tmp_path):
    process, theirs = owner
    process.kill()
    process.wait()
    elsewhere = theirs.rename(tmp_path / "elsewhere")
    (tmp_path / "gradysim-sitl-link").symlink_to(elsewhere)
    FleetFolder().remove()
    assert (elsewhere / "0" / "log").exists()
