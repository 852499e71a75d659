"""Native beacons compared with INET and ns-3: CPU seconds of the network alone.

configs/reference/beacons.ini with 200 and 500 nodes that broadcast for 60 s. Goals with 200 nodes: at least
200 times faster than INET 4.5.4 (release build), and 75 times faster than ns-3 3.44 at its fastest (-O3
-march=native), both recorded on one machine. Goal with 500 nodes: less than 1 s.

bench/ns3/beacons.cpp is the same scenario for ns-3. If Debian's ns-3 is there (`make bench` tries to install
it), both run in turn, so that the ratio is from one machine. Debian's ns-3 is not the fastest.
"""

import json
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path
from statistics import median
from typing import Any

from findings import record, recorded
from gradysim.integrated.run import run
from gradysim.results.result import RunResult
from gradysim.scenario import Scenario, load_scenarios

ROOT = Path(__file__).resolve().parents[2]
CONFIG = ROOT / "configs" / "reference" / "beacons.ini"
SOURCE = ROOT / "bench" / "ns3" / "beacons.cpp"
PROGRAM = ROOT / "build" / "bench" / "beacons_ns3"
MODULES = ("core", "network", "mobility", "propagation", "wifi")
RECORDED = recorded()
INET_CPU_S = {nodes: float(RECORDED[f"inet.beacons_{nodes}"]["value"]) for nodes in (200, 500)}
NS3_FASTEST_CPU_S = {nodes: float(RECORDED[f"ns3.beacons_{nodes}"]["value"]) for nodes in (200, 500)}
INET_GOAL, NS3_GOAL, GOAL_500_S = 200.0, 75.0, 1.0
ROUNDS = 5


@cache
def scenario(nodes: int) -> Scenario:
    (loaded,) = load_scenarios(CONFIG, overrides=[f"*.numNodes = {nodes}"])
    return loaded


def native(nodes: int) -> RunResult:
    """Run it once and print the figures."""
    result = run(scenario(nodes))
    broadcast = result.outcomes["frames"]["broadcast"]
    print(
        f"    {nodes} nodes: {result.cpu_s:.3f} s, {result.outcomes['messages']['broadcast']['sent']} sent, "
        f"{broadcast['delivered']} delivered, {result.events / result.cpu_s / 1e6:.1f} M events/s",
        flush=True,
    )
    return result


def ns3_program() -> Path | None:
    """Return the program for ns-3, compiled if it is older than its source; None without ns-3."""
    if PROGRAM.exists() and PROGRAM.stat().st_mtime > SOURCE.stat().st_mtime:
        return PROGRAM
    compiler = shutil.which("c++") or shutil.which("g++")
    if not Path("/usr/include/ns3/wifi-module.h").exists() or compiler is None:
        print("ns-3 is not installed (Debian's libns3-dev): no comparison on this machine")
        return None
    libraries = [f"-lns3-{module}" for module in MODULES]
    PROGRAM.parent.mkdir(parents=True, exist_ok=True)
    command = [compiler, "-std=c++17", "-O3", str(SOURCE), "-o", str(PROGRAM), *libraries]
    outcome = subprocess.run(command, capture_output=True, text=True, check=False)
    if outcome.returncode != 0:
        print(f"bench/ns3/beacons.cpp does not compile, no comparison:\n{outcome.stderr[-2000:]}")
        return None
    return PROGRAM


def ns3(program: Path, nodes: int) -> dict[str, Any]:
    """Run ns-3 once with the same positions and print the figures."""
    places = "\n".join(f"{x} {y}" for x, y, _ in (spec.initial_position for spec in scenario(nodes).nodes))
    output = subprocess.run(
        [program, str(nodes)], input=places, capture_output=True, text=True, check=True
    ).stdout
    result: dict[str, Any] = json.loads(output)
    print(
        f"    {nodes} nodes, ns-3: {result['cpu_s']:.2f} s, {result['sent']} sent, "
        f"{result['received']} received",
        flush=True,
    )
    return result


def main() -> bool:
    """Print all figures; return whether a goal was missed."""
    program = ns3_program()
    cpu_s, ratios = [], []
    for _ in range(ROUNDS):
        cpu_s.append(native(200).cpu_s)
        if program is not None and len(ratios) < 3:
            ratios.append(ns3(program, 200)["cpu_s"] / cpu_s[-1])
    large_s = median(native(500).cpu_s for _ in range(3))
    small_s = median(cpu_s)
    (in_python,) = load_scenarios(CONFIG, "Python200")
    python_s = median(run(in_python).cpu_s for _ in range(3))
    for name, seconds in (("200", small_s), ("500", large_s), ("python_200", python_s)):
        record(f"beacons_native.{name}", f"{seconds:.3g}", "s", "bench/python/beacons_native.py")
    inet_ratio, ns3_ratio = INET_CPU_S[200] / small_s, NS3_FASTEST_CPU_S[200] / small_s
    print(f"200 nodes: {small_s:.3f} s")
    print(f"    INET, recorded, / that: {inet_ratio:.0f} (goal: at least {INET_GOAL:g})")
    print(f"    ns-3 at its fastest, recorded, / that: {ns3_ratio:.0f} (goal: at least {NS3_GOAL:g})")
    if ratios:
        print(
            f"    Debian's ns-3 on this machine, in turn, / that: {median(ratios):.0f} (goal: {NS3_GOAL:g})"
        )
    print(f"500 nodes: {large_s:.3f} s (goal: at most {GOAL_500_S:g} s)")
    print(f"    INET, recorded, / that: {INET_CPU_S[500] / large_s:.0f}")
    print(f"    ns-3 at its fastest, recorded, / that: {NS3_FASTEST_CPU_S[500] / large_s:.0f}")
    return inet_ratio < INET_GOAL or ns3_ratio < NS3_GOAL or large_s > GOAL_500_S


if __name__ == "__main__":
    sys.exit(main())
