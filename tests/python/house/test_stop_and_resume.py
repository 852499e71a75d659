"""The output in docs/how-to/stop-and-resume.md is the output of the commands."""

from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.cli.errors import INTERRUPTED, OK
from gradysim.cli.run_all import text_of_unfinished

GUIDE = "docs/how-to/stop-and-resume.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.mark.verify
def test_the_missing_runs_are_resumed(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], shows: Callable[..., None], tmp_path: Path
) -> None:
    new, stopped, resumed = code_blocks(GUIDE, "sh")[0].splitlines()
    shell(new, tmp_path)
    shell(f"{stopped.partition('#')[0]} -r 0..11", tmp_path)
    printed = shell(f"{resumed} 2>&1", tmp_path)
    shows(GUIDE, printed, 1, part=True)
    assert len([line for line in printed.splitlines() if line.startswith("Study run")]) == 8


@pytest.mark.verify
def test_repetitions_are_added(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], tmp_path: Path
) -> None:
    shell("gradysim new swarm", tmp_path)
    study = (tmp_path / "swarm/swarm.ini").read_text().partition("[Config Study]")[2].splitlines()
    for line in code_blocks(GUIDE, "ini")[0].splitlines()[1:]:
        assert line in study
    command = "gradysim run swarm/swarm.ini -c Study --result-dir results --quiet"
    shell(command, tmp_path)
    printed = shell(f"{command} --set repeat=6 --resume 2>&1", tmp_path)
    assert "20 of 24 runs are in results (0..19) and left out" in printed


def test_the_unfinished_runs_are_named_as_shown(code_blocks: CodeBlocks) -> None:
    shown = code_blocks(GUIDE, "text")[0].splitlines()[-1]
    assert shown == text_of_unfinished("Study", range(20), {**dict.fromkeys(range(12), OK), 12: INTERRUPTED})
