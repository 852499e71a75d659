"""What docs/how-to/move-at-random.md shows is what happens."""

import importlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gradysim.protocol.plugin.random_mobility import RandomMobilityConfig
from gradysim.scenario import load_scenarios
from python.viewing import watched

pytest.importorskip("gradysim._netsim")

GUIDE = "docs/how-to/move-at-random.md"

Saved = Callable[..., Path]


@pytest.mark.parametrize("mode", ["prototype", "integrated"])
def test_a_trip_stays_in_its_box(saved: Saved, mode: str) -> None:
    module: Any = importlib.import_module(f"gradysim.{mode}.run")
    (scenario,) = load_scenarios(saved(GUIDE, python="wander.py", ini="wander.ini") / "wander.ini")
    targets = [node.tracked_variables["target"] for node in module.run(scenario).nodes]
    assert len(set(targets)) == 3
    box = RandomMobilityConfig((-100, 100), (0, 50), (10, 30))
    for target in targets:
        for value, (lowest, highest) in zip(target, (box.x_range, box.y_range, box.z_range), strict=True):
            assert lowest <= value <= highest


@pytest.mark.verify
def test_it_can_be_watched(code_blocks: Callable[[str, str], list[str]], saved: Saved) -> None:
    (command,) = code_blocks(GUIDE, "sh")
    assert watched(command.strip(), saved(GUIDE, python="wander.py", ini="wander.ini"))[0]["complete"]


def test_its_types_hold(saved: Saved, type_errors: Callable[[Path], str]) -> None:
    assert type_errors(saved(GUIDE, python="wander.py", ini="wander.ini") / "wander.py") == ""
