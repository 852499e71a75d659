"""What docs/contributing/how-it-is-tested.md names is there."""

import re
from pathlib import Path

import pytest


@pytest.fixture
def page(root: Path) -> str:
    return (root / "docs/contributing/how-it-is-tested.md").read_text(encoding="utf-8")


def test_its_commands_are_there(root: Path, page: str) -> None:
    named = set(re.findall(r"\bmake ([a-z-]+)", page))
    targets = set(re.findall(r"^([a-z-]+):", (root / "Makefile").read_text(), re.MULTILINE))
    assert len(named) > 10
    assert named - targets == set()


def test_its_directories_are_there(root: Path, page: str) -> None:
    paths = set(re.findall(r"`((?:tests|bench)[\w./-]*)`", page))
    assert len(paths) > 12
    assert {path for path in paths if not (root / path).exists()} == set()


def test_every_directory_of_tests_is_named(root: Path, page: str) -> None:
    directories = {file.parent for file in (root / "tests").glob("*/*") if "__pycache__" not in file.parts}
    unnamed = {f"tests/{directory.name}" for directory in directories} - set(
        re.findall(r"`(tests/\w+)", page)
    )
    assert unnamed == set()
