"""The output in docs/how-to/run-a-study.md is the output of the commands."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/run-a-study.md"

CodeBlocks = Callable[[str, str], list[str]]


def without_times(printed: str) -> list[str]:
    return [re.sub(r"[\d.]+ s$", "", line) for line in printed.splitlines()]


@pytest.mark.verify
def test_its_commands_print_what_is_shown(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], tmp_path: Path
) -> None:
    study, listing, check, jobs = code_blocks(GUIDE, "sh")
    first_lines, runs, checked = code_blocks(GUIDE, "text")
    printed = without_times(shell(study, tmp_path))
    assert len(printed) > 20
    assert set(without_times(first_lines)) <= set(printed)
    assert (tmp_path / "results/Study-#2.integrated.json").is_file()
    assert shell(listing, tmp_path) == runs
    assert shell(check, tmp_path) == checked
    assert set(without_times(shell(jobs, tmp_path))) <= set(printed)


def test_its_study_is_that_of_the_project(code_blocks: CodeBlocks, swarm: Path) -> None:
    text = (swarm / "swarm/swarm.ini").read_text()
    (lines,) = code_blocks(GUIDE, "ini")
    assert [line for line in lines.splitlines() if line not in text.splitlines()] == []
