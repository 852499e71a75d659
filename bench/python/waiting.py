"""What users wait for besides the engine, as ratios of what ran in the same call, with their goals.

CPU time of this process and of its children; the smallest of several rounds, since other processes only add
to it.
"""

import os
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage
from subprocess import DEVNULL, run

import gradysim
from gradysim.scenario import Scenario, load_scenarios

ROUNDS = 5
COMMAND = [sys.executable, "-m", "gradysim"]
STUDY_RUNS = 50
STEPS = 1000


def cpu_s(call: Callable[[], object]) -> float:
    """Return the least CPU time of a call in s, with that of the processes that it starts."""

    def used_s() -> float:
        children = getrusage(RUSAGE_CHILDREN)
        return time.process_time() + children.ru_utime + children.ru_stime

    times = []
    for _ in range(ROUNDS):
        begin_s = used_s()
        call()
        times.append(used_s() - begin_s)
    return min(times)


def command_s(*arguments: object) -> float:
    """Return the CPU time of a command in s."""
    return cpu_s(lambda: run([*map(str, arguments)], stdout=DEVNULL, check=True))


def step_us(scenario: Scenario) -> float:
    """Return the CPU time of a `run_until` without an event, in µs."""
    with gradysim.start(scenario) as stepped:
        stepped.run_until(1.0)
        until_s = (stepped.time_s + step * 1e-9 for step in range(1, ROUNDS * STEPS + 1))
        return cpu_s(lambda: [stepped.run_until(next(until_s)) for _ in range(STEPS)]) / STEPS * 1e6


def drawn_ms(file: Path, nodes: int) -> float:
    """Return the CPU time that drawing two coordinates of each node adds to reading a run, in ms."""

    def read_s(*drawn: str) -> float:
        lines = [f"*.numVehicles={nodes}", "repeat=20", *drawn]
        return cpu_s(lambda: load_scenarios(file, overrides=lines)) / 20

    draws = [f"*.vehicles[*].mobility.initial{axis}=uniform(0m, 100m)" for axis in "XZ"]
    return (read_s(*draws) - read_s()) * 1e3


def main() -> None:
    """Print a line for each figure, and its goal."""
    with tempfile.TemporaryDirectory() as folder:
        run([*COMMAND, "new", "swarm"], cwd=folder, stdout=DEVNULL, check=True)
        file = Path(folder) / "swarm" / "swarm.ini"
        os.utime(file.parent, (0, 0))  # a folder that changed within the last second is listed at each step
        nothing_s = command_s(sys.executable, "-c", "pass")

        def of_nothing(*arguments: object) -> float:
            return command_s(*COMMAND, *arguments) / nothing_s

        short = ("--set", "sim-time-limit=1s", "--quiet")
        figures = [
            ("run_until without an event, µs", step_us(load_scenarios(file)[0]), 20.0),
            ("reading a run with 100 drawn positions, ms", drawn_ms(file, 100), 1.0),
            ("gradysim --help / python -c pass", of_nothing("--help"), 5.0),
            ("gradysim run of 1 s / python -c pass", of_nothing("run", file, *short), 12.0),
            ("gradysim runs / python -c pass", of_nothing("runs", file), 8.0),
            ("gradysim check / python -c pass", of_nothing("check", file), 8.0),
        ]
        study = load_scenarios(file, overrides=["sim-time-limit=1s", f"repeat={STUDY_RUNS}"])
        alone_s = cpu_s(lambda: [gradysim.run(scenario) for scenario in study])
        results = ("--set", f"repeat={STUDY_RUNS}", "--result-dir", Path(folder) / "results", "--replace")
        in_a_study_s = (
            command_s(*COMMAND, "run", file, *short, *results) - of_nothing("runs", file) * nothing_s
        )
        figures.append(("a short run of a study / gradysim.run", in_a_study_s / alone_s, 2.0))
    for name, value, goal in figures:
        print(f"{name}: {value:.3g} (goal: at most {goal:g}, {'reached' if value <= goal else 'missed'})")


if __name__ == "__main__":
    main()
