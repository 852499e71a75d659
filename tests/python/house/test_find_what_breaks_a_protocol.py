"""The commands of docs/how-to/find-what-breaks-a-protocol.md print what the page shows."""

from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/find-what-breaks-a-protocol.md"

CodeBlocks = Callable[[str, str], list[str]]


@pytest.mark.verify
def test_its_command_prints_what_it_shows(
    code_blocks: CodeBlocks, shell: Callable[[str, Path], str], shows: Callable[..., None], clone: Path
) -> None:
    (command,) = code_blocks(GUIDE, "sh")
    shows(GUIDE, shell(f"{command.rstrip()} || test $? = 1", clone), terminal=True)
    for level in ("radio", "interference"):
        assert (clone / f"results/ZigZag5Synchronised-{level}-#0.html").stat().st_size


def test_its_test_passes(code_blocks: CodeBlocks, clone: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(clone)
    names: dict[str, Callable[[], None]] = {}
    exec("\n".join(code_blocks(GUIDE, "python")), names)
    names["test_data_arrives_on_real_radios"]()
