"""The figures of docs/explanation/what-is-true.md agree with the verification."""

import re
from pathlib import Path

FIGURE = re.compile(r"\d+\.\d+ %|0 of \d+|\d+e-\d+|0\.\d{3,}")


def test_the_measured_figures_are_in_the_verification(root: Path) -> None:
    page = (root / "docs/explanation/what-is-true.md").read_text(encoding="utf-8")
    verification = (root / "docs/verification/README.md").read_text(encoding="utf-8").replace(" %", "%")
    cells = re.findall(r"^\|(?: [^|]*\|){4} (.+) \|$", page, re.MULTILINE)
    figures = [
        figure.replace(" ", "") if "%" in figure else figure
        for cell in cells
        for figure in FIGURE.findall(cell)
    ]
    assert len(figures) > 10
    assert [
        figure for figure in figures if not re.search(rf"(?<![\d.]){re.escape(figure)}", verification)
    ] == []
