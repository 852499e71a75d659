"""What docs/how-to/write-a-plugin.md shows is what happens."""

from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/write-a-plugin.md"

CodeBlocks = Callable[[str, str], list[str]]
Saved = Callable[..., Path]


@pytest.mark.parametrize("mode", ["prototype", "integrated"])
def test_pings_are_answered_and_not_seen(
    code_blocks: CodeBlocks,
    saved: Saved,
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
    mode: str,
) -> None:
    (command,) = code_blocks(GUIDE, "sh")
    folder = saved(GUIDE, python="ping.py", ini="ping.ini")
    shows(GUIDE, shell(f"{command.strip()} --mode {mode}", folder), part=True)


def test_its_types_hold(saved: Saved, type_errors: Callable[[Path], str]) -> None:
    assert type_errors(saved(GUIDE, python="ping.py", ini="ping.ini") / "ping.py") == ""
