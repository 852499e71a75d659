"""The rows of docs/how-to/find-lost-frames.md in python are those of its summary."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/find-lost-frames.md"

CodeBlocks = Callable[[str, str], list[str]]


def test_its_rows_of_interference_are_those_of_the_summary(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], tmp_path: Path
) -> None:
    names: dict[str, Any] = {}
    exec("\n".join(code_blocks(GUIDE, "python")), names)
    shell(f"{code_blocks(GUIDE, 'sh')[0].strip()} --quiet --json > runs.jsonl", tmp_path)
    rows = list(names["interference"](str(tmp_path / "runs.jsonl")))
    table = code_blocks(GUIDE, "text")[0]
    assert {row["at"] for row in rows} == {"vehicles[0]", "station"}
    for row in rows:
        assert row["run"] == 6
        (line,) = (
            line for line in table.splitlines() if line.startswith(row["at"]) and f"{row['by']} " in line
        )
        assert f"{row['by']} {row['lost']}" in line
