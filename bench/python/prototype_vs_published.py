"""Prototype mode compared with the published package, gradysim 0.8.2, on the same script.

Goals: at least 4 times the speed of the published package (CPU time, median of pairs of runs in turn). With
10, 50 and 100 nodes, each with telemetry at 100 Hz and one broadcast a second. Memory must not grow with
simulated time.

The published package is installed into a separate environment, build/published. It is only run.
"""

import json
import os
import subprocess
import sys
from pathlib import Path
from statistics import median
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
WORKLOAD = Path(__file__).parent / "workload" / "telemetry_and_broadcasts.py"
ENVIRONMENT = ROOT / "build" / "published"
PUBLISHED = "0.8.2"
SPEED_GOAL = 4.0
MEMORY_GOAL_KB = 1024
NODE_SECONDS = 4000.0
ROUNDS = 5


def published_python() -> Path:
    """Return the interpreter of the published package's environment, which is created if necessary."""
    python = ENVIRONMENT / "bin" / "python"
    version = "from importlib.metadata import version; print(version('gradysim'))"
    if not python.exists() or output_of([python, "-c", version], check=False) != PUBLISHED:
        print(f"Installing gradysim {PUBLISHED} into {ENVIRONMENT.relative_to(ROOT)}")
        subprocess.run([sys.executable, "-m", "venv", ENVIRONMENT], check=True)
        command = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        subprocess.run([*command, f"gradysim=={PUBLISHED}"], check=True)
    return python


def output_of(command: list[Any], *, check: bool = True, **variables: str) -> str:
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"} | variables
    outcome = subprocess.run(
        command,
        check=check,
        cwd=ROOT / "build",
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    )
    return outcome.stdout.decode().strip()


def published(nodes: int, simulated_s: float) -> dict[str, Any]:
    result: dict[str, Any] = json.loads(output_of([PUBLISHED_PYTHON, WORKLOAD, str(nodes), str(simulated_s)]))
    return result


def ours(nodes: int, simulated_s: float) -> dict[str, Any]:
    result: dict[str, Any] = json.loads(
        output_of([sys.executable, WORKLOAD, str(nodes), str(simulated_s)], PYTHONPATH=str(ROOT / "python"))
    )
    return result


def compare(nodes: int) -> tuple[float, int]:
    """Return the speed-up, and the growth of memory in kB."""
    simulated_s = NODE_SECONDS / nodes
    ratios, growths = [], []
    for _ in range(ROUNDS):
        theirs, own = published(nodes, simulated_s), ours(nodes, simulated_s)
        if abs(theirs["callbacks"] / own["callbacks"] - 1) > 0.02:
            raise SystemExit(f"not the same work: {theirs['callbacks']} and {own['callbacks']} callbacks")
        ratios.append(theirs["cpu_s"] / own["cpu_s"])
        growths.append(own["memory_growth_kb"])
        print(
            f"    {nodes} nodes, {simulated_s:g} s: published {theirs['cpu_s']:.2f} s "
            f"(+{theirs['memory_growth_kb']} kB), ours {own['cpu_s']:.2f} s (+{own['memory_growth_kb']} kB), "
            f"{simulated_s / own['cpu_s']:.0f} times real time"
        )
    return median(ratios), int(median(growths))


if __name__ == "__main__":
    PUBLISHED_PYTHON = published_python()
    missed = False
    for nodes in (10, 50, 100):
        ratio, growth_kb = compare(nodes)
        missed |= ratio < SPEED_GOAL or growth_kb > MEMORY_GOAL_KB
        print(
            f"{nodes} nodes: {ratio:.2f} times as fast as published (goal: at least {SPEED_GOAL:g}); "
            f"memory grew by {growth_kb} kB (goal: at most {MEMORY_GOAL_KB})"
        )
    sys.exit(missed)
