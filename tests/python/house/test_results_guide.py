"""What docs/guides/results.md shows runs with the README's first protocol, and its table names all fields."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.config import Scenario
from gradysim.prototype.run import run

GUIDE = "docs/guides/results.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.fixture
def shown(code_blocks: CodeBlocks) -> dict[str, Any]:
    """The functions that it defines."""
    names: dict[str, Any] = {}
    exec("\n".join(code_blocks(GUIDE, "python")), names)
    return names


@pytest.fixture
def folder(code_blocks: CodeBlocks, tmp_path: Path) -> Path:
    """A folder with the first protocol."""
    for language, name in [("python", "hello.py"), ("ini", "hello.ini")]:
        (tmp_path / name).write_text(code_blocks("README.md", language)[0], encoding="utf-8")
    return tmp_path


def test_rows_of_both_modes_come_out_of_the_file(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], folder: Path, shown: dict[str, Any]
) -> None:
    (commands,) = code_blocks(GUIDE, "sh")
    shell(commands, folder)
    file = str(folder / "runs.jsonl")
    rows = list(shown["rows"](file))
    assert len(rows) == 2 * 5 * 4
    assert rows[0].keys() == {"mode", "run", "node", "heard"}
    assert shown["heard"](file, "prototype") == (177, 0)


def test_an_interrupted_run_is_left_out(folder: Path, shown: dict[str, Any]) -> None:
    file = folder / "runs.jsonl"
    file.write_text(json.dumps({"interrupted": True, "nodes": [{"name": "nodes[0]"}]}) + "\n")
    assert list(shown["rows"](str(file))) == []


def test_its_study_compares_both_modes(folder: Path, shown: dict[str, Any]) -> None:
    totals = list(shown["study"](str(folder / "hello.ini"), ["0s", "100ms"]))
    assert len(totals) == 2 * 3 * 2
    assert totals[:2] == [("0s", "prototype", 0, 720), ("0s", "integrated", 0, 0)]
    assert totals[-2:] == [("100ms", "prototype", 2, 708), ("100ms", "integrated", 2, 708)]


def test_its_table_has_all_fields(root: Path, make_scenario: Callable[..., Scenario]) -> None:
    rows = re.findall(r"^\| (`.*?) \|", (root / GUIDE).read_text(), re.MULTILINE)
    names = {name for row in rows for name in re.findall(r"`(\w+)`", row)}
    assert names == set(run(make_scenario()).to_json_object())
