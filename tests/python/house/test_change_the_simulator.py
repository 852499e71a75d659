"""The files and names in docs/contributing/change-the-simulator.md exist."""

import re
from pathlib import Path

import pytest


@pytest.fixture
def guide(root: Path) -> str:
    return (root / "docs/contributing/change-the-simulator.md").read_text(encoding="utf-8")


def test_its_files_are_there(root: Path, guide: str) -> None:
    paths = re.findall(r"`((?:cpp|python|tests|docs)/[\w./-]+)`", guide)
    assert len(paths) > 30
    assert [path for path in paths if not (root / path).exists()] == []


def test_the_way_of_a_message_leads_through_functions_that_are_there(root: Path, guide: str) -> None:
    rows = re.findall(r"^\| .* \| `([\w./]+)` \| (.*) \|$", guide, re.MULTILINE)
    assert len(rows) > 15
    missing = [
        f"{path}: {name}"
        for path, names in rows
        for name in re.findall(r"`(?:\w+::)?(\w+)`", names)
        if not re.search(rf"\b{name}\b", (root / path).read_text(encoding="utf-8"))
    ]
    assert missing == []
