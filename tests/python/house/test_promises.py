"""Each promise of docs/promises.md has a test."""

import re


def test_the_tests_of_all_promises_are_there(root):
    rows = re.findall(r"^\| (.*) \| (`tests/.*`) \|$", (root / "docs/promises.md").read_text(), re.MULTILINE)
    assert len(rows) > 10
    missing = [
        file for _, files in rows for file in re.findall("`(.*?)`", files) if not (root / file).is_file()
    ]
    assert missing == []
