from pathlib import Path

import pytest

from gradysim.scenario.errors.sibling_files import file_meant


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name in ("relay.py", "r9.py", "sensor.py", "relays.txt"):
        (tmp_path / name).touch()
    return tmp_path


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("realy.py", "; did you mean `relay.py`?"),
        ("relay", "; did you mean `relay.py`?"),
        ("relays.py", "; did you mean `relay.py`?"),
        ("a.py", ""),
        ("hello.py", ""),
    ],
)
def test_files_are_alike_by_what_stands_before_the_suffix(folder: Path, name: str, hint: str) -> None:
    assert file_meant(folder / name, (".py",)) == hint


def test_there_may_be_several_suffixes(folder: Path) -> None:
    assert file_meant(folder / "relys.txt", (".py", ".txt")) == "; did you mean `relays.txt`?"


def test_the_folder_stands_there_as_the_user_wrote_it(folder: Path) -> None:
    hint = file_meant(folder / "realy.py", (".py",), "../protocols/realy.py")
    assert hint == "; did you mean `../protocols/relay.py`?"


@pytest.mark.parametrize("folder", ["nowhere", "n" * 5000, "n\0"])
def test_a_folder_that_cannot_be_has_none(tmp_path: Path, folder: str) -> None:
    assert file_meant(tmp_path / folder / "missing.ini", (".ini",)) == ""
