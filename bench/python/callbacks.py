"""Callbacks of Python protocols per second in integrated mode, including the network.

configs/reference/beacons.ini with 500 nodes whose Python protocol only sends and counts. About 70 nodes
receive each broadcast. Goal: at least 1 million callbacks per second of wall time, including the build of the
network.
"""

import sys
from pathlib import Path
from statistics import median

from gradysim.integrated.run import run
from gradysim.scenario import load_scenarios

CONFIG = Path(__file__).resolve().parents[2] / "configs" / "reference" / "beacons.ini"
GOAL = 1e6
ROUNDS = 5


def callbacks_per_second() -> float:
    """Run it once."""
    (scenario,) = load_scenarios(CONFIG, "Python")
    result = run(scenario)
    tracked = [node.tracked_variables for node in result.nodes]
    # There are as many timers as messages sent. Each node also has initialize and finish.
    callbacks = sum(int(str(each["sent"])) + int(str(each["received"])) + 2 for each in tracked)
    print(
        f"    {callbacks} callbacks, {result.wall_s:.2f} s wall, {result.cpu_s:.2f} s CPU: "
        f"{callbacks / result.wall_s / 1e6:.2f} M/s of wall time, "
        f"{callbacks / result.cpu_s / 1e6:.2f} M/s of CPU time",
        flush=True,
    )
    return callbacks / result.wall_s


if __name__ == "__main__":
    rate = median(callbacks_per_second() for _ in range(ROUNDS))
    print(f"callbacks of Python per second: {rate / 1e6:.2f} M (goal: at least {GOAL / 1e6:g} M)")
    sys.exit(rate < GOAL)
