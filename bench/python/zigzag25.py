"""Speed of integrated mode relative to prototype mode, in spite of its radios.

ZigZag25 over eight simulated hours, once in each mode in turn, in CPU seconds. Goal: integrated mode takes at
most a fifth of the time of prototype mode. An argument sets the hours: `zigzag25.py 0.5` for half an hour.
"""

import sys
from pathlib import Path
from statistics import median

import gradysim.integrated.run
import gradysim.prototype.run
from gradysim.results.result import RunResult
from gradysim.scenario import load_scenarios

CONFIG = Path(__file__).resolve().parents[2] / "configs" / "zigzag.ini"
GOAL = 5.0


def describe(result: RunResult) -> str:
    """Return the speed of a run as text."""
    return (
        f"    {result.mode:10} {result.cpu_s:7.2f} s for {result.events} events: "
        f"{result.events / result.cpu_s / 1e3:.0f} k events/s, "
        f"{result.sim_time_s / result.cpu_s:.0f} times real time"
    )


def compare(hours: float, rounds: int) -> float:
    """Return how many times longer prototype mode takes: the median of `rounds` pairs of runs."""
    (scenario,) = load_scenarios(CONFIG, "ZigZag25", overrides=[f"sim-time-limit={hours}h"])
    ratios = []
    for _ in range(rounds):
        integrated = gradysim.integrated.run.run(scenario)
        prototype = gradysim.prototype.run.run(scenario)
        print(describe(integrated), describe(prototype), sep="\n", flush=True)
        ratios.append(prototype.cpu_s / integrated.cpu_s)
    return median(ratios)


if __name__ == "__main__":
    hours = float(sys.argv[1]) if len(sys.argv) > 1 else 8.0
    ratio = compare(hours, rounds=3)
    print(f"ZigZag25 over {hours:g} h, prototype / integrated: {ratio:.2f} (goal: at least {GOAL:g})")
