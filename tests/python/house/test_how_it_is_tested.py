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


def test_the_numbers_of_random_networks_are_those_of_the_test(root: Path, page: str) -> None:
    source = (root / "tests/verification/test_oracle.py").read_text(encoding="utf-8")
    counts = re.findall(r"(?:random|exact)_case, (\d+), (\d+)\)", source)
    some, all_of_them = (sum(int(each[place]) for each in counts) for place in (0, 1))
    for text in (page, (root / "docs/verification/README.md").read_text(encoding="utf-8")):
        words = " ".join(text.split())
        assert re.search(rf"`make test` compares {some} .*?`make verify` {all_of_them:,}\.", words)
