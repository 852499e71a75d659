"""Figures and table of docs/explanation/realism-levels.md are those of the guide and of the levels."""

import re
from pathlib import Path

from gradysim.ladder.levels import LEVELS

PAGE = "docs/explanation/realism-levels.md"


def test_readings_and_times_are_those_of_the_guide(root: Path) -> None:
    page = (root / PAGE).read_text(encoding="utf-8")
    guide = (root / "docs/how-to/repeat-the-paper.md").read_text(encoding="utf-8")
    figures = re.findall(r"\b\d,\d{3}\b(?! nodes)|\b\d+\.\d+(?= (?:s|m)\b)|\b428\b", page)
    assert len(figures) > 8
    assert [figure for figure in figures if figure not in guide] == []


def test_its_table_has_all_levels(root: Path) -> None:
    page = (root / PAGE).read_text(encoding="utf-8")
    table = re.search(r"\| level \| adds \|.*\n\|---.*\n((?:\|.*\n)+)", page)
    assert table is not None
    assert table[1].splitlines() == [
        f"| {level.name} | {level.adds} |"
        f" {', '.join(f'`{key}={value}`' for key, value in level.off.items())} |"
        for level in LEVELS
    ]
