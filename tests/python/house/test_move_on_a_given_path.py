"""What docs/how-to/move-on-a-given-path.md shows is what happens."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.cli.app import main

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/move-on-a-given-path.md"


@pytest.mark.parametrize("mode", ["integrated", "prototype"])
def test_the_nodes_end_where_the_page_says(
    saved: Callable[..., Path],
    code_blocks: Callable[[str, str], list[str]],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    shows: Callable[..., None],
    mode: str,
) -> None:
    (command,) = code_blocks(GUIDE, "sh")
    monkeypatch.chdir(saved(GUIDE, python="scout.py", ini="patrol.ini"))
    assert main([*command.split()[1:], "--mode", mode]) == 0
    shows(GUIDE, capsys.readouterr().out, part=True)
