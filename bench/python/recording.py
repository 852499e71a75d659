"""Cost of recording a run for a replay, with all receptions.

ZigZag25 over eight simulated hours, with and without recording in turn, in CPU seconds of the simulating
thread. Goal: at most a quarter more. An argument sets the hours: `recording.py 0.5` for half an hour.
"""

import sys
import tempfile
import time
from pathlib import Path
from statistics import median

from gradysim.integrated.run import run
from gradysim.replay.sink import ReplayWriter
from gradysim.scenario import load_scenarios

CONFIG = Path(__file__).resolve().parents[2] / "configs" / "zigzag.ini"
GOAL = 1.25


def thread_s(hours: float, page: Path | None) -> float:
    """Return the CPU time of a run in s. The run writes a page if `page` is given."""
    (scenario,) = load_scenarios(CONFIG, "ZigZag25", overrides=[f"sim-time-limit={hours}h"])
    start = time.thread_time()
    run(scenario, replay=None if page is None else ReplayWriter(page))
    return time.thread_time() - start


if __name__ == "__main__":
    hours = float(sys.argv[1]) if len(sys.argv) > 1 else 8.0
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "replay.html"
        ratios = []
        for _ in range(3):
            plain_s = thread_s(hours, None)
            ratios.append(thread_s(hours, page) / plain_s)
        size_mb = page.stat().st_size / 1e6
    print(
        f"ZigZag25 over {hours:g} h, recorded / not: {median(ratios):.2f} (goal: at most {GOAL:g});"
        f" a page of {size_mb:.1f} MB"
    )
