"""The output in docs/reference/example.md is correct."""

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

import gradysim.integrated.run
import gradysim.prototype.run
from gradysim.scenario import load_scenarios

PAGE = "docs/reference/example.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.fixture
def file(code_blocks: CodeBlocks, tmp_path: Path) -> Path:
    """Return the .ini file of a reader, with the study."""
    (tmp_path / "hello.py").write_text(code_blocks(PAGE, "python")[0], encoding="utf-8")
    file = tmp_path / "hello.ini"
    file.write_text("\n".join(code_blocks(PAGE, "ini")), encoding="utf-8")
    return file


def test_its_commands_print_what_is_said(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], file: Path
) -> None:
    (commands,) = code_blocks(PAGE, "sh")
    lines = re.findall(r"^(gradysim run .*?) +# heard = (\d+)", commands, re.MULTILINE)
    assert len(lines) == len(commands.splitlines()) == 3
    for command, heard in lines:
        result = json.loads(shell(f"{command} --json --quiet", file.parent))
        assert [node["tracked_variables"]["heard"] for node in result["nodes"]] == [int(heard)] * 4


def test_its_study_has_thirty_runs(file: Path) -> None:
    assert len(load_scenarios(file, "Study")) == 30


def test_one_line_gives_both_modes_one_range(root: Path, file: Path) -> None:
    (line,) = re.findall(r"`(\*\*\.wlan.*communicationRange = 60m)`", (root / PAGE).read_text())
    ends = "*.nodes[*].mobility.lineStepX = 59m"
    scenario = load_scenarios(file, "Jittered", overrides=[line, ends])[0]
    for run in (gradysim.prototype.run.run, gradysim.integrated.run.run):
        heard_by = [node.tracked_variables["heard"] for node in run(scenario).nodes]
        assert heard_by == [59, 118, 118, 59]
