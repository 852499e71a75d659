"""docs/explanation/determinism.md names what the engine has."""

import re
from pathlib import Path

PAGE = "docs/explanation/determinism.md"


def test_it_names_the_purposes_of_streams(root: Path) -> None:
    page = (root / PAGE).read_text(encoding="utf-8")
    streams = (root / "cpp/netsim/kernel/random.hpp").read_text(encoding="utf-8")
    purposes = re.findall(r"^    (\w+) = \d+,", streams, re.MULTILINE)
    words = {"csma_backoff": "backoff", "parameter": "values", "position_error": "position errors"}
    (sentence,) = re.findall(r"Purposes are (.*?)\.\n", page, re.DOTALL)
    assert len(purposes) > 8
    assert [each for each in purposes if words.get(each, each.replace("_", " ")) not in sentence] == []
