"""Memory of a node, and growth of memory during a run.

Native beacons (configs/reference/beacons.ini) with 500 nodes. Goals: less than 4 kB per additional node.
Resident memory after 100 million events is within 1 MB of its value after the first tenth.
"""

import gc
import os
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from gradysim.integrated.run import IntegratedRun
from gradysim.scenario import load_scenarios

CONFIG = Path(__file__).resolve().parents[2] / "configs" / "reference" / "beacons.ini"
PER_NODE_GOAL_BYTES = 4096
GROWTH_GOAL_KB = 1024
EVENTS_GOAL = 100_000_000
NODES = 500
PAGE_BYTES = os.sysconf("SC_PAGE_SIZE")


def resident_kb() -> float:
    """Current memory of this process, in kB of 1024 bytes."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * PAGE_BYTES / 1024


def long_run() -> tuple[int, float]:
    """Run EVENTS_GOAL events or more. Return their number, and the growth of memory in kB after a tenth."""
    (probe,) = load_scenarios(CONFIG, overrides=["sim-time-limit = 11s", f"*.numNodes = {NODES}"])
    built = IntegratedRun(probe)
    built.execute()
    # A bit more, since the first second has no events and the number of events varies.
    sim_time_s = 2 + 1.01 * 10 * EVENTS_GOAL / built.result().events
    overrides = [f"sim-time-limit = {sim_time_s:.0f}s", "*.nodes[*].protocol.stop = 1000000s"]
    (scenario,) = load_scenarios(CONFIG, overrides=[*overrides, f"*.numNodes = {NODES}"])
    samples: list[tuple[float, float]] = []
    built = IntegratedRun(scenario)
    built.execute(progress=lambda time_s: samples.append((time_s, resident_kb())))
    result = built.result()
    early = [kb for time_s, kb in samples if time_s <= sim_time_s / 10]
    if not early:
        sys.exit("the run was too short to look at its memory")
    growth_kb = samples[-1][1] - early[-1]
    print(
        f"    {result.events:.3g} events in {result.cpu_s:.1f} s, "
        f"{result.events / result.cpu_s / 1e6:.1f} M/s; resident {early[-1] / 1024:.1f} MB after a tenth, "
        f"{samples[-1][1] / 1024:.1f} MB at the end"
    )
    return result.events, growth_kb


def taken_kb(nodes: int) -> float:
    """Return the growth of this process by a network of that many nodes."""
    (scenario,) = load_scenarios(CONFIG, overrides=["sim-time-limit = 5s", f"*.numNodes = {nodes}"])
    gc.collect()
    before = resident_kb()
    built = IntegratedRun(scenario)
    built.execute()
    return resident_kb() - before


def per_node() -> float:
    """Return the bytes per node, including its part of the run's memory: between 100 and 500 nodes."""
    sizes = {}
    for nodes in (100, NODES):
        # Each in a separate process, since memory freed by one run would serve the next.
        with ProcessPoolExecutor(1) as process:
            sizes[nodes] = process.submit(taken_kb, nodes).result()
    return (sizes[NODES] - sizes[100]) * 1024 / (NODES - 100)


if __name__ == "__main__":
    node_bytes = per_node()
    events, growth_kb = long_run()
    print(f"memory of a node: {node_bytes:.0f} B (goal: less than {PER_NODE_GOAL_BYTES} B)")
    print(
        f"growth over a run of {events:,} events: {growth_kb:.0f} kB (goal: at most {GROWTH_GOAL_KB} kB "
        f"over {EVENTS_GOAL:,} events or more)"
    )
    sys.exit(node_bytes >= PER_NODE_GOAL_BYTES or growth_kb > GROWTH_GOAL_KB or events < EVENTS_GOAL)
