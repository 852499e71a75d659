"""What docs/how-to/model-a-battery.md shows is what its python and ini files do."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/model-a-battery.md"


@pytest.fixture
def folder(climbers: Callable[[str, str], Path]) -> Path:
    return climbers(GUIDE, "watch.py")


def test_its_command_prints_that_all_have_landed(
    code_blocks: Callable[[str, str], list[str]],
    folder: Path,
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
) -> None:
    (command,) = code_blocks(GUIDE, "sh")
    shows(GUIDE, shell(command, folder))


def test_vehicles_stay_up_while_their_batteries_are_full(
    folder: Path, imported: Callable[[Path], Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    watch = imported(folder / "watch.py")
    monkeypatch.setattr(watch.Battery, "drain", lambda battery: None)
    assert watch.heights_at_the_end("watch.ini") == [50] * 6


def test_its_types_hold(folder: Path, type_errors: Callable[[Path], str]) -> None:
    assert type_errors(folder / "watch.py") == ""
