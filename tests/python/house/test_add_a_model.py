"""The changes of docs/contributing/add-a-model.md make a new path loss and leave other models alone."""

import json
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

GUIDE = "docs/contributing/add-a-model.md"
MODEL = "LogDistancePathLoss"
SCHEMA = "python/gradysim/scenario/schema/schema.json"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.fixture
def changes(code_blocks: CodeBlocks) -> list[tuple[str, str, str]]:
    """Return (file, lines before, lines after) of each change on the page."""
    found = []
    for block in code_blocks(GUIDE, "diff"):
        header, *lines = block.splitlines()
        before = "".join(line[1:] + "\n" for line in lines if not line.startswith("+"))
        after = "".join(line[1:] + "\n" for line in lines if not line.startswith("-"))
        found.append((header.removeprefix("+++ "), before, after))
    return found


def test_each_change_has_one_place(root: Path, changes: list[tuple[str, str, str]]) -> None:
    assert [
        file
        for file, before, _ in changes
        if ("\n" + (root / file).read_text(encoding="utf-8")).count("\n" + before) != 1
    ] == []


def test_it_takes_two_files_a_test_and_a_line_of_the_guide(changes: list[tuple[str, str, str]]) -> None:
    files = sorted({file for file, _, _ in changes})
    assert [file for file in files if file.startswith("cpp/")] == [
        "cpp/netsim/config/medium_config.hpp",
        "cpp/netsim/propagation/path_loss.cpp",
    ]
    assert [file for file in files if not file.startswith("cpp/")] == [
        "docs/how-to/choose-a-propagation-model.md",
        "tests/cpp/propagation/path_loss_test.cpp",
    ]


def test_its_files_are_there(root: Path) -> None:
    paths = re.findall(r"`((?:cpp|python|tests|docs)/[\w./-]+)`", (root / GUIDE).read_text(encoding="utf-8"))
    assert len(paths) > 15
    assert [path for path in paths if not (root / path).exists()] == []


@pytest.fixture
def changed(root: Path, tmp_path: Path, changes: list[tuple[str, str, str]]) -> Path:
    """Return a copy of the code with these changes, after `make schema`."""
    copy = tmp_path / "gradysim"
    for folder in ("cpp", "tests/cpp", "python/gradysim/scenario"):
        shutil.copytree(root / folder, copy / folder)
    (copy / "docs/how-to").mkdir(parents=True)
    for file, before, after in changes:
        if not (copy / file).exists():
            shutil.copy(root / file, copy / file)
        text = (copy / file).read_text(encoding="utf-8")
        (copy / file).write_text(text.replace(before, after), encoding="utf-8")
    subprocess.run([sys.executable, copy / "cpp/schema/write_schema.py"], check=True)
    return copy


def declarations(tree: Path) -> dict[str, dict[str, Any]]:
    """Return the declaration of each field, without how lists of keys name its readers."""
    rows = json.loads((tree / SCHEMA).read_text(encoding="utf-8"))
    for row in rows:
        if row["read_by"]:
            del row["read_by"]["shown"]
    return {row["target"]: row for row in rows}


@pytest.mark.verify
def test_following_it_gives_no_key_to_another_model(
    root: Path, changed: Path, code_blocks: CodeBlocks
) -> None:
    before, after = declarations(root), declarations(changed)
    assert after.keys() - before.keys() == {"medium.reference_loss_db"}
    different = [target for target in before if after[target] != before[target]]
    assert different == ["medium.path_loss", "medium.alpha"]
    names = [*before["medium.path_loss"]["type"]["names"]]
    assert sorted(after["medium.path_loss"]["type"]["names"]) == sorted([*names, MODEL])
    readers = [*before["medium.alpha"]["read_by"]["names"]]
    assert sorted(after["medium.alpha"]["read_by"]["names"]) == sorted([*readers, MODEL])
    assert after["medium.reference_loss_db"]["read_by"]["names"] == [MODEL]
    (ini,) = code_blocks(GUIDE, "ini")
    keys = {f"*.{row['key']}" for row in after.values()}
    assert {line.partition(" = ")[0] for line in ini.splitlines()} - keys == set()

    sources = [*(changed / "cpp/netsim/config").glob("*.cpp"), changed / "cpp/netsim/error.cpp"]
    sources += [changed / "cpp/netsim/units.cpp", changed / "cpp/netsim/propagation/path_loss.cpp"]
    sources += [changed / "tests/cpp/propagation/path_loss_test.cpp"]
    program = changed / "path_loss_test"
    command = ["c++", "-std=c++20", "-I", changed / "cpp", *sources, "-lgtest", "-lgtest_main", "-o", program]
    subprocess.run(command, check=True)
    (filter_of_tests,) = re.findall(r"ONLY='(.*)'", (root / GUIDE).read_text(encoding="utf-8"))
    for tests in (filter_of_tests, "*"):
        finished = subprocess.run([program, f"--gtest_filter={tests}"], capture_output=True, text=True)
        assert finished.returncode == 0, finished.stdout
        assert "[  PASSED  ] 0 tests" not in finished.stdout
