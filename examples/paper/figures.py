"""The two figures of the paper: data collected over time, and what the simulation of that time costs.

`python examples/paper/figures.py` runs the three sizes ten times in both modes, prints the means and writes
results/collected.png and results/cost.png. It takes some minutes; `--runs 2 --time 30min` is quick.
"""

import argparse
import os
from collections.abc import Callable, Sequence
from multiprocessing import Pool
from pathlib import Path

from matplotlib.figure import Figure
from rich import box
from rich.console import Console
from rich.progress import track
from rich.table import Table

from gradysim.results.confidence_interval import mean_with_half_width
from gradysim.scenario import load_scenarios
from observed_run import MODES, SCENARIOS, ObservedRun, Sample, observed_run

SIZES = {"ZigZag5": "#1b6ca8", "ZigZag15": "#d1495b", "ZigZag25": "#2e933c"}
"""And their colours."""
LINES = {"prototype": "--", "integrated": "-"}

Runs = dict[tuple[str, str], list[ObservedRun]]
"""{(size, mode): its runs}"""


def runs_of_both_modes(count: int, time: str, jobs: int) -> Runs:
    """Run every size `count` times in both modes, `jobs` runs at once, in processes of their own."""
    overrides = [f"repeat = {count}", f"sim-time-limit = {time}"]
    tasks = [
        (scenario, mode)
        for size in reversed(SIZES)  # the longest ones first
        for mode in MODES
        for scenario in load_scenarios(SCENARIOS, size, overrides=overrides)
    ]
    runs: Runs = {(size, mode): [] for size in SIZES for mode in MODES}
    with Pool(jobs) as pool:
        done = pool.imap(observed_run, tasks, chunksize=1)
        for (scenario, mode), run in zip(tasks, track(done, "runs", len(tasks)), strict=True):
            runs[scenario.config, mode].append(run)
    return runs


def curve(runs: Sequence[ObservedRun], value: Callable[[Sample], float]) -> list[tuple[float, float, float]]:
    """Return simulated seconds, mean over the runs, and half the width of its 95 % interval."""
    points = []
    for samples in zip(*(run.samples for run in runs), strict=True):
        mean, half_width = mean_with_half_width([value(sample) for sample in samples])
        points.append((samples[0].time_s, mean, half_width or 0.0))
    return points


def draw(file: Path, runs: Runs, value: Callable[[Sample], float], label: str) -> None:
    """Draw the mean of a value over simulated time, with its interval, for each size and mode."""
    figure = Figure(figsize=(7, 4.5), dpi=120, layout="constrained")
    axes = figure.subplots()
    for (size, mode), alike in runs.items():
        times_s, means, half_widths = zip(*curve(alike, value), strict=True)
        minutes = [time_s / 60 for time_s in times_s]
        low = [mean - half for mean, half in zip(means, half_widths, strict=True)]
        high = [mean + half for mean, half in zip(means, half_widths, strict=True)]
        axes.plot(minutes, means, LINES[mode], color=SIZES[size], label=f"{size}, {mode}")
        axes.fill_between(minutes, low, high, color=SIZES[size], alpha=0.25, linewidth=0)
    axes.set_xlabel("simulated time in minutes")
    axes.set_ylabel(label)
    axes.grid(alpha=0.25)
    axes.legend(frameon=False)
    figure.savefig(file)


def table(runs: Runs) -> Table:
    """Return the means half-way and at the end."""
    some = next(iter(runs.values()))
    half_way, end = (len(some[0].samples) - 1) // 2, -1
    printed = Table(title=f"Means of {len(some)} runs, ± 95 %", title_justify="left", box=box.SIMPLE_HEAD)
    printed.add_column("size")
    printed.add_column("mode")
    for sample in (half_way, end):
        printed.add_column(f"at {some[0].samples[sample].time_s / 60:g} min", justify="right")
    printed.add_column("processor time", justify="right")
    for (size, mode), alike in runs.items():
        readings = curve(alike, lambda sample: sample.readings)
        cells = [f"{mean:,.0f} ± {half:.0f}" for _, mean, half in (readings[half_way], readings[end])]
        _, cost_s, half_s = curve(alike, lambda sample: sample.processor_s)[end]
        printed.add_row(size, mode, *cells, f"{cost_s:.2f} ± {half_s:.2f} s")
    return printed


def main(arguments: Sequence[str] | None = None) -> None:
    """Run, print the table, write the pictures."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--runs", type=int, default=10, help="of each size in each mode (default: 10)")
    parser.add_argument("--time", default="2h", help="simulated time, from 1 min on (default: 2h)")
    parser.add_argument(
        "--jobs", type=int, default=os.cpu_count(), help="runs at once (default: one per core)"
    )
    parser.add_argument("--output", type=Path, default=Path("results"), help="folder (default: results)")
    options = parser.parse_args(arguments)
    runs = runs_of_both_modes(options.runs, options.time, options.jobs)
    Console().print(table(runs))
    options.output.mkdir(parents=True, exist_ok=True)
    collected, cost = options.output / "collected.png", options.output / "cost.png"
    draw(collected, runs, lambda sample: sample.readings, "readings at the ground station")
    draw(cost, runs, lambda sample: sample.processor_s, "processor time in s")


if __name__ == "__main__":
    main()
