from pathlib import Path

import pytest

from gradysim.config.neighbours import names_beside


def test_those_of_the_pattern_in_order(tmp_path: Path) -> None:
    for name in ("b.ini", "a.ini", "c.txt"):
        (tmp_path / name).touch()
    assert names_beside(tmp_path / "missing.ini", "*.ini") == ["a.ini", "b.ini"]


@pytest.mark.parametrize("folder", ["nowhere", "n" * 5000, "n\0"])
def test_a_folder_that_cannot_be_has_none(tmp_path: Path, folder: str) -> None:
    assert names_beside(tmp_path / folder / "missing.ini", "*.ini") == []
