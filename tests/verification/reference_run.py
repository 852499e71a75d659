"""Runs the scenarios of configs/reference in integrated mode, with changes."""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import gradysim.integrated.run
from gradysim import _netsim
from gradysim.results.result import RunResult
from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.node_spec import NodeSpec
from gradysim.scenario.schema.native_protocols import native_protocol
from gradysim.scenario.schema.protocol_modules import origin_of

_ROOT = Path(__file__).parents[2]
FOLDER = _ROOT / "configs" / "reference"
_NATIVE_NAMES = {row.python_class: row.name for row in _netsim.native_protocols()}
"""{class in Python, as "file.py:Class": the equivalent native protocol}"""


def load_reference(
    name: str, config: str = "General", *, run: int = 0, seed: int = 0, overrides: Iterable[str] = ()
) -> Scenario:
    """Return one run of configs/reference/NAME.ini; `overrides` are lines before those of the file."""
    file = FOLDER / f"{name}.ini"
    return load_scenarios(file, config, runs=[run], overrides=[*overrides, f"seed-set={seed}"])[0]


def run_reference(
    name: str, config: str = "General", *, run: int = 0, seed: int = 0, overrides: Iterable[str] = ()
) -> RunResult:
    """Return the result of `load_reference` with the same arguments.

    Native protocols replace their Python equivalents: they give the same results, as their tests show, in a
    fraction of the time.
    """
    scenario = load_reference(name, config, run=run, seed=seed, overrides=overrides)
    return gradysim.integrated.run.run(
        replace(scenario, nodes=tuple(_natively(node) for node in scenario.nodes))
    )


def _natively(node: NodeSpec) -> NodeSpec:
    origin = origin_of(node.protocol)
    if origin is None or origin.file is None:
        return node
    name = _NATIVE_NAMES.get(f"{origin.file.relative_to(_ROOT)}:{origin.name}")
    return node if name is None else replace(node, protocol=native_protocol(name))


def tracked(result: RunResult, variable: str, group: str = "") -> list[int]:
    """Return the variable of each node that tracks it, in one group or in all."""
    return [
        int(str(node.tracked_variables[variable]))
        for node in result.nodes
        if variable in node.tracked_variables and node.name.startswith(group)
    ]


def received_in_error(result: RunResult) -> int:
    """Return the broadcast frames that a radio locked on to and then lost."""
    outcomes = result.outcomes["frames"]["broadcast"]
    return outcomes["noise"] + outcomes["interference"]
