"""The commands of docs/how-to/plot-a-study.md run, and draw its pictures."""

import csv
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gradysim._netsim")
pytest.importorskip("matplotlib")

GUIDE = "docs/how-to/plot-a-study.md"

CodeBlocks = Callable[[str, str], list[str]]
Shell = Callable[[str, Path], str]


@pytest.fixture
def shown(code_blocks: CodeBlocks) -> dict[str, Any]:
    """Return the functions defined on the page."""
    names: dict[str, Any] = {}
    exec("\n".join(code_blocks(GUIDE, "python")), names)
    return names


@pytest.mark.verify
def test_its_commands_draw_its_pictures(
    code_blocks: CodeBlocks, shell: Shell, root: Path, tmp_path: Path
) -> None:
    commands = "".join(code_blocks(GUIDE, "sh")).replace(
        ".ini ", ".ini --set sim-time-limit=12s --set repeat=2 "
    )
    shell(commands.replace("results/", f"{tmp_path}/"), root)
    pictures = re.findall(r"\]\(../pictures/plots/(\w+)\.png\)", (root / GUIDE).read_text())
    assert sorted(pictures) == ["cdf", "diff", "line", "map", "outcomes", "time"]
    for name in pictures:
        for suffix in (".png", ".csv", ".json"):
            assert (tmp_path / f"{name}{suffix}").stat().st_size
        assert f"results/{name}.png" in (root / "Makefile").read_text()
    with (tmp_path / "diff.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["higher"] for row in rows] == ["0"] * 4


def test_its_function_draws_two_panels(
    shell: Shell, root: Path, shown: dict[str, Any], tmp_path: Path
) -> None:
    short = "--set sim-time-limit=5s --set repeat=2 --set '*.numScouts=${scouts=5, 10}'"
    shell(f"gradysim run configs/scouts.ini {short} --result-dir {tmp_path}/scouts --quiet", root)
    shown["two_panels"](str(tmp_path / "scouts"), str(tmp_path / "panels.pdf"))
    assert (tmp_path / "panels.pdf").read_bytes().startswith(b"%PDF")
