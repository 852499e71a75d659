"""The command of docs/how-to/desynchronize-timers.md prints what the page shows."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")
pytest.importorskip("matplotlib")

GUIDE = "docs/how-to/desynchronize-timers.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.mark.verify
def test_its_command_prints_what_it_shows(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], shows: Callable[..., None], clone: Path
) -> None:
    (command,) = code_blocks(GUIDE, "sh")
    shows(GUIDE, shell(command, clone), terminal=True)
    assert (clone / "results/jitter.png").stat().st_size


def test_its_protocol_sends_each_second_and_a_little_later(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], tmp_path: Path
) -> None:
    (tmp_path / "reporter.py").write_text(code_blocks(GUIDE, "python")[0])
    (tmp_path / "reporter.ini").write_text(
        '[General]\nsim-time-limit=100s\n*.numNodes=2\n*.nodes[*].protocol.class="reporter.py:Reporter"\n'
    )
    result = json.loads(shell("gradysim run reporter.ini --json", tmp_path))
    assert result["outcomes"]["messages"]["broadcast"]["sent"] == 2 * 99
