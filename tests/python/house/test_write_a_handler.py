"""What docs/how-to/write-a-handler.md shows is what its python and ini files do."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/write-a-handler.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.fixture
def folder(climbers: Callable[[str, str], Path]) -> Path:
    return climbers(GUIDE, "watch.py")


def test_its_command_prints_the_heights(
    code_blocks: CodeBlocks, folder: Path, shell: Callable[[str, Path], str], shows: Callable[..., None]
) -> None:
    (command,) = code_blocks(GUIDE, "sh")
    shows(GUIDE, shell(command, folder))


def test_each_message_has_its_time_and_receiver(folder: Path, imported: Callable[[Path], Any]) -> None:
    rows = imported(folder / "watch.py").messages("watch.ini")
    assert sorted(node for _, node, _ in rows) == [0, 0, 1, 1, 2, 2]
    assert all(2 < time < 3.1 and message == "climbing" for time, _, message in rows)


def test_its_types_hold(folder: Path, type_errors: Callable[[Path], str]) -> None:
    assert type_errors(folder / "watch.py") == ""
