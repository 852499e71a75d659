"""What docs/how-to/fly-a-mission.md shows is what happens."""

from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/fly-a-mission.md"

CodeBlocks = Callable[[str, str], list[str]]
Saved = Callable[..., Path]


def test_its_commands_print_the_table_in_both_modes(
    code_blocks: CodeBlocks, saved: Saved, shell: Callable[[str, Path], str], shows: Callable[..., None]
) -> None:
    (commands,) = code_blocks(GUIDE, "sh")
    folder = saved(GUIDE, python="patrol.py", ini="patrol.ini")
    for command in commands.splitlines():
        shows(GUIDE, shell(command, folder), part=True)


def test_its_types_hold(saved: Saved, type_errors: Callable[[Path], str]) -> None:
    assert type_errors(saved(GUIDE, python="patrol.py", ini="patrol.ini") / "patrol.py") == ""
