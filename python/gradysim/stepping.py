"""`gradysim.start`: a run that the caller advances step by step."""

from typing import Any, get_args

from gradysim.execution.scenario_run import ScenarioRun
from gradysim.results.result import Mode
from gradysim.scenario.scenario import Scenario


def start(scenario: Scenario, mode: Mode = "integrated", **options: Any) -> ScenarioRun:
    """Build a run; see `gradysim.start`."""
    check_mode(mode)
    if mode == "prototype":
        from gradysim.prototype.run import PrototypeRun

        return PrototypeRun(scenario, **options)
    from gradysim.integrated.run import IntegratedRun

    return IntegratedRun(scenario, **options)


def check_mode(mode: object) -> None:
    """Raise ValueError if there is no such mode."""
    if mode not in get_args(Mode):
        raise ValueError(f"there is no mode {mode!r}; expected 'integrated' or 'prototype'")
