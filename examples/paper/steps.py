"""Steps in which the paper's authors developed ZigZag: the effect of each step, in both modes.

`python examples/paper/steps.py` runs the smallest size, `python examples/paper/steps.py ZigZag15` another
one. docs/how-to/repeat-the-paper.md explains the output.
"""

import sys
from collections.abc import Sequence
from statistics import fmean
from typing import NamedTuple

from rich import box
from rich.console import Console
from rich.table import Table

from gradysim.scenario import load_scenarios
from observed_run import MODES, SCENARIOS, ObservedRun, observed_run


class Step(NamedTuple):
    """A version of the protocol.

    Attributes:
        text: Description of the change.
        config: Suffix of the configuration's name.
        overrides: Arguments of `--set`.
    """

    text: str
    config: str
    overrides: tuple[str, ...]


NO_TIMEOUT = "*.uavs[*].protocol.interaction_timeout = 0s"
ALL_AT_ONCE = "*.uavs[*].protocol.launch_interval = 0s"

STEPS = (
    Step("1 as first written", "Synchronised", (NO_TIMEOUT, ALL_AT_ONCE)),
    Step("2 timeout of 5 s", "Synchronised", (ALL_AT_ONCE,)),
    Step("3 launches 30 s apart", "Synchronised", ()),
    Step("4 random offset", "", ()),
)


def exchanges(run: ObservedRun) -> int:
    """Return the number of exchanges of UAVs, with each other (both count) and with the ground station."""
    counts = [node.tracked_variables.get("interactions", 0) for node in run.result.nodes]
    return sum(count for count in counts if isinstance(count, int))


def nearest_m(run: ObservedRun) -> float:
    """Return the distance in m from a UAV to the nearest other one, mean of the second half of the run."""
    return fmean(sample.nearest_m for sample in run.samples[len(run.samples) // 2 :])


def row(size: str, step: Step, mode: str, *overrides: str) -> list[str]:
    """Run a step in a mode and return its row of the table."""
    (scenario, *_) = load_scenarios(SCENARIOS, size + step.config, overrides=[*overrides, *step.overrides])
    run = observed_run(scenario, mode)
    counts = f"{run.samples[-1].readings:,}", f"{exchanges(run):,}"
    return [step.text, mode, *counts, f"{nearest_m(run):.0f} m"]


def main(arguments: Sequence[str]) -> None:
    """Run each step in both modes and print a table."""
    size = arguments[0] if arguments else "ZigZag5"
    console = Console()
    table = Table(title=f"{size}, run 0", title_justify="left", box=box.SIMPLE_HEAD)
    for name in ("step", "mode"):
        table.add_column(name)
    for name in ("readings", "exchanges", "nearest UAV"):
        table.add_column(name, justify="right")
    for step in STEPS:
        for mode in MODES:
            with console.status(f"{step.text}, {mode} mode"):
                table.add_row(*row(size, step, mode))
    console.print(table)


if __name__ == "__main__":
    main(sys.argv[1:])
