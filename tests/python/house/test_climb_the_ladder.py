"""The commands of docs/how-to/climb-the-ladder.md print what the page shows."""

import contextlib
import io
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")
pytest.importorskip("matplotlib")

GUIDE = "docs/how-to/climb-the-ladder.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.mark.verify
@pytest.mark.parametrize("number", [0, 1])
def test_its_commands_print_what_it_shows(
    number: int,
    code_blocks: CodeBlocks,
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
    clone: Path,
) -> None:
    (clone / "harsh.ini").write_text(code_blocks(GUIDE, "ini")[0])
    shows(GUIDE, shell(code_blocks(GUIDE, "sh")[number], clone), number)
    assert number or (clone / "results/ladder.png").stat().st_size


@pytest.mark.verify
def test_its_script_prints_what_it_shows(
    code_blocks: CodeBlocks, shows: Callable[..., None], clone: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(clone)
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec("\n".join(code_blocks(GUIDE, "python")), {})
    shows(GUIDE, printed.getvalue(), 2)
