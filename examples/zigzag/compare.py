"""Run ZigZag in both modes and compare what the ground station collected: `make demo`.

`python examples/zigzag/compare.py` runs the three sizes, and the smallest one without jitter. To run other
configurations of configs/zigzag.ini, give their names: `python examples/zigzag/compare.py ZigZag5`.
"""

import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from rich import box
from rich.console import Console
from rich.table import Table

import gradysim.integrated.run
import gradysim.prototype.run
from gradysim.results.outcomes import Outcomes
from gradysim.results.result import RunResult
from gradysim.scenario import Scenario, load_scenarios

SCENARIOS = Path(__file__).parents[2] / "configs" / "zigzag.ini"
CONFIGS = ("ZigZag5", "ZigZag15", "ZigZag25", "ZigZag5Synchronised")
MODES: dict[str, Callable[[Scenario], RunResult]] = {
    "prototype": gradysim.prototype.run.run,
    "integrated": gradysim.integrated.run.run,
}
# Outcomes of receptions within reach of the destination: their names in results, and their meaning.
OUTCOMES = {
    "delivered": "frames delivered",
    "noise": "lost to noise",
    "interference": "lost to interference",
    "receiver_transmitting": "lost, receiver was transmitting",
    "receiver_locked": "lost, receiver was receiving another one",
}


def collected(result: RunResult) -> int:
    """Return how many readings had arrived at the ground station when the run ended."""
    station = next(node for node in result.nodes if node.name == "groundStation")
    value = station.tracked_variables["data"]
    assert isinstance(value, int)
    return value


def frames_with(outcome: str, outcomes: Outcomes) -> str:
    """Return the number of receptions with this outcome at their destinations; a dash if it does not exist.

    Acknowledgements are left out.
    """
    frames = outcomes["frames"]
    counts = [frames[kind][outcome] for kind in ("broadcast", "unicast") if outcome in frames[kind]]
    return f"{sum(counts):,}" if counts else "-"


def comparison(scenario: Scenario, results: dict[str, RunResult]) -> Table:
    """Return a column for each mode."""
    table = Table(
        title=f"[bold]{scenario.config}[/]: {scenario.description}", title_justify="left", box=box.SIMPLE_HEAD
    )
    table.add_column(f"{scenario.sim_time_limit_s / 3600:g} simulated hours")
    for mode in results:
        table.add_column(mode, justify="right")
    ran = results.values()
    table.add_row(
        "readings at the ground station", *(f"{collected(result):,}" for result in ran), style="bold"
    )
    for outcome, text in OUTCOMES.items():
        table.add_row(text, *(frames_with(outcome, result.outcomes) for result in ran))
    table.add_row("wall time", *(f"{result.wall_s:.1f} s" for result in ran))
    return table


def main(configs: Sequence[str]) -> None:
    """Run the first run of each configuration in both modes and print a table for each."""
    console = Console()
    for config in configs:
        scenario = load_scenarios(SCENARIOS, config)[0]
        results = {}
        for mode, run in MODES.items():
            with console.status(f"{config}, {mode} mode"):
                results[mode] = run(scenario)
        console.print(comparison(scenario, results))


if __name__ == "__main__":
    main(sys.argv[1:] or CONFIGS)
