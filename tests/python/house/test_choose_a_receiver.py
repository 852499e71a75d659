"""The file and the lines in docs/how-to/choose-a-receiver.md are valid."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

import gradysim.integrated.run
from gradysim.integrated.network_lint import lint_networks
from gradysim.scenario import load_scenarios


@pytest.fixture
def guide(root: Path) -> str:
    return (root / "docs/how-to/choose-a-receiver.md").read_text(encoding="utf-8")


def test_its_command_prints_what_it_shows(
    root: Path,
    code_blocks: Callable[[str, str], list[str]],
    shell: Callable[[str, Path], str],
    shows: Callable[..., None],
) -> None:
    page = "docs/how-to/choose-a-receiver.md"
    shows(page, shell(code_blocks(page, "sh")[0], root), part=True)


def test_its_lines_and_its_table_run(root: Path, guide: str, tmp_path: Path) -> None:
    ((lines,), (table,)) = (
        re.findall(rf"^```{kind}\n(.*?)^```", guide, re.MULTILINE | re.DOTALL) for kind in ("ini", "csv")
    )
    (tmp_path / "rates.csv").write_text(table)
    file = tmp_path / "all.ini"
    file.write_text(f"[General]\n{lines}\ninclude {root}/configs/reference/jittered.ini\n")
    (scenario,) = load_scenarios(file, overrides=["sim-time-limit = 2.1s"])
    assert not lint_networks([scenario])
    fates = gradysim.integrated.run.run(scenario).fates["frames"]["broadcast"]
    assert fates["delivered"] > 0
    assert fates["preamble_undetected"] > 0
