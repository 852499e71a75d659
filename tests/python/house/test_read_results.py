"""The output in docs/how-to/read-results.md is correct."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/read-results.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.fixture
def shown(code_blocks: CodeBlocks) -> dict[str, Any]:
    """Return the functions defined on the page."""
    names: dict[str, Any] = {}
    exec("\n".join(code_blocks(GUIDE, "python")), names)
    return names


@pytest.mark.verify
def test_rows_of_both_modes_come_out_of_the_file(
    code_blocks: CodeBlocks,
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
    tmp_path: Path,
    shown: dict[str, Any],
) -> None:
    (commands,) = code_blocks(GUIDE, "sh")
    shell(commands, tmp_path)
    file = str(tmp_path / "runs.jsonl")
    rows = list(shown["rows"](file))
    assert len(rows) == 2 * 5 * (3 + 6 + 11 + 21)  # in each mode five runs of 2, 5, 10 and 20 vehicles
    shows(GUIDE, f"{rows[0]}\n{rows[1]}")
    assert shown["heard"](file, "prototype", 20) == (20 * 59, 0)


def test_an_interrupted_run_is_left_out(tmp_path: Path, shown: dict[str, Any]) -> None:
    file = tmp_path / "runs.jsonl"
    file.write_text(json.dumps({"interrupted": True, "nodes": [{"name": "nodes[0]"}]}) + "\n")
    assert list(shown["rows"](str(file))) == []
