"""Runs of the protocols of the showcases, in prototype mode."""

from collections.abc import Callable
from pathlib import Path

import pytest

from gradysim.prototype.run import run
from gradysim.results.result import NodeResult
from gradysim.scenario import load_scenarios

Ran = Callable[..., dict[str, NodeResult]]


@pytest.fixture
def ran(tmp_path: Path) -> Ran:
    """`ran(lines, limit_s=60)`: {name of a node: its result} of a run with these lines."""

    def results(lines: str, limit_s: float = 60) -> dict[str, NodeResult]:
        file = tmp_path / "showcase.ini"
        file.write_text(f"[General]\nsim-time-limit = {limit_s}s\n{lines}\n")
        (scenario,) = load_scenarios(file)
        return {node.name: node for node in run(scenario).nodes}

    return results
