"""docs/reference/keys.md is the output of the command."""

from pathlib import Path

import pytest

from gradysim.cli.app import main


def test_the_page_is_the_commands(root: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("gradysim._netsim")
    assert main(["keys", "--markdown"]) == 0
    assert (root / "docs/reference/keys.md").read_text(encoding="utf-8") == capsys.readouterr().out, (
        "run gradysim keys --markdown > docs/reference/keys.md"
    )
