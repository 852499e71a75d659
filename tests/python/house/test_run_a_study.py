"""The output in docs/how-to/run-a-study.md is the output of the commands."""

from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")


GUIDE = "docs/how-to/run-a-study.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.mark.verify
def test_its_commands_print_what_is_shown(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], shows: Callable[..., None], tmp_path: Path
) -> None:
    study, listing, check, jobs = code_blocks(GUIDE, "sh")
    printed = shell(study, tmp_path)
    shows(GUIDE, printed, 0, part=True, changing=True)
    assert (tmp_path / "results/Study-#2.integrated.json").is_file()
    shows(GUIDE, shell(listing, tmp_path), 1)
    shows(GUIDE, shell(check, tmp_path), 2)
    runs, again = (
        {line.rpartition(",")[0] for line in text.splitlines()} for text in (printed, shell(jobs, tmp_path))
    )
    assert again <= runs


def test_its_study_is_that_of_the_project(code_blocks: CodeBlocks, swarm: Path) -> None:
    text = (swarm / "swarm/swarm.ini").read_text()
    (lines,) = code_blocks(GUIDE, "ini")
    assert [line for line in lines.splitlines() if line not in text.splitlines()] == []
