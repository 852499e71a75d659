"""The commands of docs/how-to/choose-the-number-of-runs.md print what the page shows."""

from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/choose-the-number-of-runs.md"


@pytest.mark.verify
def test_its_commands_print_what_it_shows(
    code_blocks: Callable[[str, str], list[str]], shell: Callable[[str, Path], str], tmp_path: Path
) -> None:
    first, resumed = code_blocks(GUIDE, "sh")
    new, study = first.split("\n", 1)
    shell(new, tmp_path)
    for commands, shown in zip((study, resumed), code_blocks(GUIDE, "text"), strict=True):
        printed = [line.rstrip() for line in shell(commands, tmp_path).splitlines()]
        assert printed == shown.splitlines()
