"""What docs/how-to/use-the-visualization-handler.md shows is what its python and ini files do."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/use-the-visualization-handler.md"


@pytest.fixture
def folder(climbers: Callable[[str, str], Path]) -> Path:
    return climbers(GUIDE, "watch.py")


def test_its_command_shows_ten_seconds_in_real_time(
    code_blocks: Callable[[str, str], list[str]],
    folder: Path,
    imported: Callable[[Path], Any],
    wall_clock: Any,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    watch = imported(folder / "watch.py")
    configuration = watch.VisualizationConfiguration
    monkeypatch.setattr(
        watch, "VisualizationConfiguration", lambda **settings: configuration(port=0, **settings)
    )
    (command,) = code_blocks(GUIDE, "sh")
    started = wall_clock.now
    exec(command.split('"')[1])
    assert wall_clock.now - started == pytest.approx(10)


def test_its_types_hold(folder: Path, type_errors: Callable[[Path], str]) -> None:
    assert type_errors(folder / "watch.py") == ""
