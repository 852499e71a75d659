"""Fly ZigZag in both modes and compare what the ground station collected: `make demo`.

`python examples/zigzag/compare.py` takes ZigZag5, with and without jitter; other configurations of
configs/zigzag.ini are given by name: `python examples/zigzag/compare.py ZigZag15 ZigZag25`.
"""

import sys
from collections.abc import Callable
from pathlib import Path

from rich import box
from rich.console import Console
from rich.table import Table

import gradysim.integrated.run
import gradysim.prototype.run
from gradysim.config import Scenario, load_scenarios
from gradysim.results.run_result import Fates, RunResult

SCENARIOS = Path(__file__).parents[2] / "configs" / "zigzag.ini"
CONFIGS = ("ZigZag5", "ZigZag5Synchronised")
MODES: dict[str, Callable[[Scenario], RunResult]] = {
    "prototype": gradysim.prototype.run.run,
    "integrated": gradysim.integrated.run.run,
}
# The fates of copies of frames that came within reach of their receiver, as the ledger names them.
FATES = ("delivered", "noise", "interference", "receiver_transmitting", "receiver_locked")


def collected(result: RunResult) -> int:
    """Return how many readings had arrived at the ground station when the run ended."""
    station = next(node for node in result.nodes if node.name == "groundStation")
    value = station.tracked_variables["data"]
    assert isinstance(value, int)
    return value


def frames_with(fate: str, fates: Fates) -> str:
    """Return how many copies of frames had this fate, of all kinds together; a dash where it is not known."""
    counts = [kind[fate] for kind in fates.get("frames", {}).values() if fate in kind]
    return f"{sum(counts):,}" if counts else "-"


def compare(configs: tuple[str, ...], console: Console) -> None:
    """Run the first run of each configuration in both modes and print a row for each."""
    table = Table(box=box.SIMPLE_HEAD)
    table.add_column("configuration")
    table.add_column("mode")
    table.add_column("readings at the\nground station", justify="right", style="bold")
    for fate in FATES:
        table.add_column(("frames: " if fate == FATES[0] else "") + fate.replace("_", "\n"), justify="right")
    table.add_column("wall time", justify="right")
    for config in configs:
        scenario = load_scenarios(SCENARIOS, config)[0]
        for mode, run in MODES.items():
            with console.status(
                f"{config}, {mode} mode: {scenario.sim_time_limit_s / 3600:g} simulated hours"
            ):
                result = run(scenario)
            table.add_row(
                config,
                mode,
                f"{collected(result):,}",
                *(frames_with(fate, result.fates) for fate in FATES),
                f"{result.wall_s:.1f} s",
            )
        table.add_section()
    console.print(table)


if __name__ == "__main__":
    compare(tuple(sys.argv[1:]) or CONFIGS, Console())
