"""The command of docs/how-to/desynchronize-timers.md prints what the page shows."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")
pytest.importorskip("matplotlib")

GUIDE = "docs/how-to/desynchronize-timers.md"

CodeBlocks = Callable[[str, str], list[str]]


def test_its_command_prints_what_it_shows(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], root: Path, tmp_path: Path
) -> None:
    for name in ("configs", "examples"):
        (tmp_path / name).symlink_to(root / name)
    (command,) = code_blocks(GUIDE, "sh")
    assert shell(command, tmp_path).split() == code_blocks(GUIDE, "text")[0].split()
    assert (tmp_path / "results/jitter.png").stat().st_size


def test_its_protocol_waits_for_a_random_time(code_blocks: CodeBlocks) -> None:
    names: dict[str, Any] = {}
    exec("\n".join(code_blocks(GUIDE, "python")), names)
    assert names["Reporter"].jitter == 0.01
