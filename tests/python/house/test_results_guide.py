"""What docs/guides/results.md shows runs with the README's first protocol, and its table names all fields."""

import json
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.config.scenario import Scenario
from gradysim.prototype.run import run


def blocks(document: Path, language: str) -> list[str]:
    """The snippets of a document in one language."""
    return re.findall(rf"^```{language}\n(.*?)^```", document.read_text(encoding="utf-8"), re.M | re.S)


@pytest.fixture
def guide(root: Path) -> Path:
    return root / "docs/guides/results.md"


@pytest.fixture
def shown(guide: Path) -> dict[str, Any]:
    """The functions that it defines."""
    names: dict[str, Any] = {}
    for program in blocks(guide, "python"):
        exec(program, names)
    return names


@pytest.fixture
def folder(root: Path, tmp_path: Path) -> Path:
    """A folder with the first protocol."""
    for language, name in [("python", "hello.py"), ("ini", "hello.ini")]:
        (tmp_path / name).write_text(blocks(root / "README.md", language)[0], encoding="utf-8")
    return tmp_path


@pytest.fixture
def runs(guide: Path, folder: Path) -> Path:
    """The file that its commands write."""
    (commands,) = blocks(guide, "sh")
    for line in commands.splitlines():
        command, target = re.split(r" >>? ", line)
        done = subprocess.run(
            [sys.executable, "-m", *command.split()],
            cwd=folder,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
            capture_output=True,
            check=True,
        )
        with (folder / target).open("ab") as file:
            file.write(done.stdout)
    return folder / "runs.jsonl"


def test_rows_of_both_modes_come_out_of_the_file(runs: Path, shown: dict[str, Any]) -> None:
    rows = list(shown["rows"](str(runs)))
    assert len(rows) == 2 * 5 * 4
    assert rows[0].keys() == {"mode", "run", "node", "heard"}
    assert shown["heard"](str(runs), "prototype") == (177, 0)


def test_an_interrupted_run_is_left_out(folder: Path, shown: dict[str, Any]) -> None:
    file = folder / "runs.jsonl"
    file.write_text(json.dumps({"interrupted": True, "nodes": [{"name": "nodes[0]"}]}) + "\n")
    assert list(shown["rows"](str(file))) == []


def test_its_study_compares_both_modes(folder: Path, shown: dict[str, Any]) -> None:
    totals = list(shown["study"](str(folder / "hello.ini"), ["0s", "100ms"]))
    assert len(totals) == 2 * 3 * 2
    assert totals[:2] == [("0s", "prototype", 0, 720), ("0s", "integrated", 0, 0)]
    assert totals[-2:] == [("100ms", "prototype", 2, 708), ("100ms", "integrated", 2, 708)]


def test_its_table_has_all_fields(guide: Path, make_scenario: Callable[..., Scenario]) -> None:
    names = set(re.findall(r"`(\w+)`", " ".join(re.findall(r"^\| (`.*?) \|", guide.read_text(), re.M))))
    assert names == set(run(make_scenario()).to_json_object())
