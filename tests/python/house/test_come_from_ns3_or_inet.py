"""The commands of docs/how-to/come-from-ns3-or-inet.md in sh print what is shown."""

from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

PAGE = "docs/how-to/come-from-ns3-or-inet.md"


def test_its_command_prints_the_outcomes(
    code_blocks: Callable[[str, str], list[str]],
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
    tmp_path: Path,
) -> None:
    shows(PAGE, shell(code_blocks(PAGE, "sh")[0], tmp_path), part=True)
