"""The beacons scenario with the positions and first sending times of a reference run."""

from collections.abc import Sequence
from dataclasses import replace

import gradysim.integrated.run
from gradysim.config import Scenario
from gradysim.results.run_result import RunResult
from verification.reference_data import Row
from verification.reference_run import load_reference


def beacon_network(nodes: Sequence[Row]) -> Scenario:
    """configs/reference/beacons.ini with these nodes: columns x_m, y_m, first_send_us."""
    return load_reference(
        "beacons",
        overrides=[
            f"*.numNodes = {len(nodes)}",
            "*.nodes[*].protocol.spread = 0s",
            *(
                f"*.nodes[{index}].{key} = {row[column]}{unit}"
                for index, row in enumerate(nodes)
                for key, column, unit in (
                    ("mobility.initialX", "x_m", "m"),
                    ("mobility.initialY", "y_m", "m"),
                    ("protocol.first_send", "first_send_us", "us"),
                )
            ),
        ],
    )


def run_with_seed(scenario: Scenario, seed: int) -> RunResult:
    """The result of the scenario with that seed."""
    return gradysim.integrated.run.run(replace(scenario, seed=seed))
