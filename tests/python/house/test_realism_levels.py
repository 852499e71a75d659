"""The figures of docs/explanation/realism-levels.md agree with the guide that measures them."""

import re
from pathlib import Path


def test_readings_and_times_are_those_of_the_guide(root: Path) -> None:
    page = (root / "docs/explanation/realism-levels.md").read_text(encoding="utf-8")
    guide = (root / "docs/how-to/repeat-the-paper.md").read_text(encoding="utf-8")
    figures = re.findall(r"\b\d,\d{3}\b(?! nodes)|\b\d+\.\d+(?= (?:s|m)\b)|\b428\b", page)
    assert len(figures) > 8
    assert [figure for figure in figures if figure not in guide] == []
