"""What docs/how-to/follow-a-leader.md shows is what happens."""

import importlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.scenario import load_scenarios

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/follow-a-leader.md"

CodeBlocks = Callable[[str, str], list[str]]
Saved = Callable[..., Path]


def test_its_command_prints_the_table(
    code_blocks: CodeBlocks, saved: Saved, shell: Callable[[str, Path], str], shows: Callable[..., None]
) -> None:
    (command,) = code_blocks(GUIDE, "sh")
    shows(GUIDE, shell(command, saved(GUIDE, python="convoy.py", ini="convoy.ini")), part=True)


@pytest.mark.parametrize("mode", ["prototype", "integrated"])
def test_followers_queue_up_behind_their_leader(saved: Saved, mode: str) -> None:
    module: Any = importlib.import_module(f"gradysim.{mode}.run")
    (scenario,) = load_scenarios(saved(GUIDE, python="convoy.py", ini="convoy.ini") / "convoy.ini")
    result = module.run(scenario)
    assert result.nodes[0].tracked_variables["followers"] == [1, 2, 3]
    for node in result.nodes:
        assert node.position == pytest.approx((0, 50 - 5 * node.id, 20))


def test_the_script_flies_in_formation(saved: Saved, imported: Callable[[Path], Any]) -> None:
    positions = imported(saved(GUIDE, python="convoy.py", ini="convoy.ini") / "convoy.py").fly_in_formation()
    assert positions == [pytest.approx((0, 50 - 5 * node_id, 20)) for node_id in range(4)]


def test_its_types_hold(saved: Saved, type_errors: Callable[[Path], str]) -> None:
    assert type_errors(saved(GUIDE, python="convoy.py", ini="convoy.ini") / "convoy.py") == ""
