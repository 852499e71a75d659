"""The commands of docs/how-to/compare-two-studies.md print what the page shows, and draw its picture."""

import contextlib
import io
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")
pytest.importorskip("matplotlib")

GUIDE = "docs/how-to/compare-two-studies.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.mark.verify
def test_its_commands_print_what_it_shows(
    code_blocks: CodeBlocks,
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
    root: Path,
    clone: Path,
) -> None:
    studies, others, modes = code_blocks(GUIDE, "sh")
    for number, commands in enumerate((studies, modes)):
        shows(GUIDE, shell(commands, clone), number)
    assert (clone / "results/compare.png").stat().st_size
    assert "results/compare.png" in (root / "Makefile").read_text()
    shell(others, clone)
    lines = (clone / "results/compare-reports.csv").read_text().splitlines()
    assert "base reports" in lines[1]


def test_its_script_prints_what_it_shows(code_blocks: CodeBlocks, shows: Callable[..., None]) -> None:
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec("\n".join(code_blocks(GUIDE, "python")), {})
    shows(GUIDE, printed.getvalue(), 2)
