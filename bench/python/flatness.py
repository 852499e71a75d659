"""Cost of a delivered frame for a user: building and running the network in a separate process.

The beacons of configs/reference/beacons.ini for 60 s, with 100 nodes in its square of 1 km and with 10,000 at
the same density. Goal: 10,000 nodes take at most 1.3 times as much CPU time per delivered frame as 100. Large
and small networks run in turn, since the speed of the machine may change. The median of the ratios counts.
`bench/cpp/beacon_bench.cpp` has the same ratio for the running engine alone.
"""

import json
import subprocess
import sys
from collections.abc import Iterator
from math import sqrt
from pathlib import Path
from statistics import mean, median

from findings import record

CONFIG = Path(__file__).resolve().parents[2] / "configs" / "reference" / "beacons.ini"
NODES_PER_KM2 = 100
GOAL_TIMES = 1.3
ROUNDS = 9
SMALL_NETWORKS = 4  # per round


def arguments(nodes: int) -> Iterator[str]:
    """Yield the settings for the positions and the protocol of all nodes."""
    side_m = 1000 * sqrt(nodes / NODES_PER_KM2)
    for line in (
        f"*.numNodes = {nodes}",
        "*.nodes[*].protocol.typename = BeaconProtocol",
        f"*.nodes[*].mobility.initialX = uniform(0m, {side_m}m)",
        f"*.nodes[*].mobility.initialY = uniform(0m, {side_m}m)",
    ):
        yield from ("--set", line)


def ns_per_frame(nodes: int, seed: int) -> float:
    """Run it once."""
    command = [sys.executable, "-m", "gradysim", "run", str(CONFIG), "--seed", str(seed), "--json"]
    output = subprocess.run([*command, *arguments(nodes)], capture_output=True, text=True, check=True).stdout
    result = json.loads(output)
    return float(result["cpu_s"] / result["outcomes"]["frames"]["broadcast"]["delivered"] * 1e9)


def main() -> bool:
    """Print the figures; return whether the goal was missed."""
    few_ns, many_ns = [], []
    for turn in range(ROUNDS):
        first_seed = 1 + turn * SMALL_NETWORKS
        seeds = range(first_seed, first_seed + SMALL_NETWORKS)
        few_ns.append(mean(ns_per_frame(100, seed) for seed in seeds))
        many_ns.append(ns_per_frame(10_000, 1 + turn))
    times = median(many / few for few, many in zip(few_ns, many_ns, strict=True))
    print(
        f"100 nodes: {median(few_ns):.0f} ns for each delivered frame; 10,000 nodes: {median(many_ns):.0f} ns"
    )
    print(f"    the second / the first, median of {ROUNDS}: {times:.2f} (goal: at most {GOAL_TIMES:g})")
    record("flatness.ratio", f"{times:.2f}", "", "bench/python/flatness.py")
    return times > GOAL_TIMES


if __name__ == "__main__":
    sys.exit(main())
