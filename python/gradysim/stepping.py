"""`gradysim.start`: a run that the caller advances step by step."""

from typing import Any

from gradysim.results.result import Mode
from gradysim.results.scenario_run import ScenarioRun
from gradysim.scenario.scenario import Scenario


def start(scenario: Scenario, mode: Mode = "integrated", **options: Any) -> ScenarioRun:
    """Build a run of a scenario, to be advanced step by step.

    For example::

        with gradysim.start(scenario) as run:
            run.run_until(10.0)
            print(run.node("uavs[2]").position)
            run.run_until()
        result = run.result()

    Args:
        scenario: One of those that `gradysim.scenario.load_scenarios` returns.
        mode: "integrated" or "prototype".
        options: Arguments of `gradysim.integrated.run.IntegratedRun` or
            `gradysim.prototype.run.PrototypeRun`, such as `handlers` and `replay`.

    Raises:
        ValueError: There is no such mode.
        ConfigError: The mode does not accept a value of the scenario. See the two classes for others.
    """
    if mode == "prototype":
        from gradysim.prototype.run import PrototypeRun

        return PrototypeRun(scenario, **options)
    if mode == "integrated":
        from gradysim.integrated.run import IntegratedRun

        return IntegratedRun(scenario, **options)
    raise ValueError(f"there is no mode {mode!r}; expected 'integrated' or 'prototype'")
