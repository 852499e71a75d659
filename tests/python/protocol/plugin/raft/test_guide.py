"""The output in docs/how-to/agree-with-raft.md is correct."""

import importlib
import re
import runpy
from pathlib import Path

import pytest

from gradysim.scenario import load_scenarios

GUIDE = Path(__file__).parents[5] / "docs/how-to/agree-with-raft.md"


@pytest.fixture
def folder(tmp_path):
    """Return a directory with the guide's two files."""
    for language, name in [("python", "agreement.py"), ("ini", "agreement.ini")]:
        (block,) = re.findall(rf"^```{language}\n(.*?)^```", GUIDE.read_text(), re.MULTILINE | re.DOTALL)
        (tmp_path / name).write_text(block)
    return tmp_path


def test_the_program_agrees(folder, capsys):
    command, shown = (
        re.findall(rf"^```{language}\n(.*?)^```", GUIDE.read_text(), re.MULTILINE | re.DOTALL)[0]
        for language in ("sh", "text")
    )
    runpy.run_path(str(folder / command.split()[1]), run_name="__main__")
    assert capsys.readouterr().out == shown


@pytest.mark.parametrize("mode", ["prototype", "integrated"])
def test_the_scenario_agrees_in_both_modes(folder, mode):
    if mode == "integrated":
        pytest.importorskip("gradysim._netsim")
    (scenario,) = load_scenarios(folder / "agreement.ini")
    result = importlib.import_module(f"gradysim.{mode}.run").run(scenario)
    assert [node.tracked_variables["departure_s"] for node in result.nodes] == [1.0] * 5
