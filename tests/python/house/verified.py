"""Finds the statement of docs/verification/README.md that a figure on another page repeats."""

import re
from pathlib import Path

FIGURE = re.compile(r"\d+(?:\.\d+)? %|\d+\.\d+ times|0 of \d+|\d+e-\d+|0\.\d{3,}")
"""Figures that are measured."""


def statement(root: Path, phrase: str) -> str:
    """Return the one row of a table, or sentence, that contains the phrase. Percentages have no blank."""
    text = (root / "docs/verification/README.md").read_text(encoding="utf-8")
    rows = [line for line in text.splitlines() if line.startswith("|")]
    paragraphs = re.sub(r"^\|.*\n", "", text, flags=re.MULTILINE).split("\n\n")
    sentences = [
        each for paragraph in paragraphs for each in re.split(r"(?<=[.:]) ", " ".join(paragraph.split()))
    ]
    found = [each for each in (*rows, *sentences) if phrase in each]
    assert len(found) == 1, (phrase, found)
    return found[0].replace(" %", "%")


def repeats(root: Path, figure: str, phrase: str) -> bool:
    """Return whether the statement with the phrase has the figure."""
    return (
        re.search(rf"(?<![\d.]){re.escape(figure.replace(' %', '%'))}", statement(root, phrase)) is not None
    )
