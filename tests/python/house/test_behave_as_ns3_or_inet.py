"""The lines and the tables in docs/how-to/behave-as-ns3-or-inet.md are valid."""

from collections.abc import Callable
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim")

import gradysim.integrated.run
from gradysim.integrated.network_lint import lint_networks
from gradysim.scenario import load_scenarios

PAGE = "docs/how-to/behave-as-ns3-or-inet.md"


@pytest.mark.parametrize("config", ["AsNs3", "AsInet"])
def test_its_lines_run(
    code_blocks: Callable[[str, str], list[str]], root: Path, tmp_path: Path, config: str
) -> None:
    file = tmp_path / "both.ini"
    lines = code_blocks(PAGE, "ini")[0].replace("include", "extends = ZigZag5\ninclude")
    file.write_text(f"include {root}/configs/zigzag.ini\n{lines}")
    (scenario,) = load_scenarios(file, config, runs=[0], overrides=["sim-time-limit = 2s"])
    assert not lint_networks([scenario])
    assert gradysim.integrated.run.run(scenario).outcomes["frames"]["broadcast"]["delivered"] > 0
