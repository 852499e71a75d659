"""Record the figures of netsim_bench: `python -m findings FILE`, with the JSON of Google Benchmark."""

import json
import sys
from pathlib import Path

from findings import FILE, record

COMMAND = "build/bench/netsim_bench"


def main(file: Path, to: Path = FILE) -> None:
    """Record the times of a frame, their ratios over the number of nodes, and the time of a cache line."""

    def write(name: str, value: str, unit: str = "") -> None:
        record(f"bench.{name}", value, unit, COMMAND, to)

    results = {each["name"]: each for each in json.loads(file.read_text(encoding="utf-8"))["benchmarks"]}
    ns = {name: each["ns_per_frame"] for name, each in results.items() if "ns_per_frame" in each}
    for nodes in (100, 1_000, 10_000):
        write(f"standing_{nodes}", f"{ns[f'standing/{nodes}']:.0f}", "ns")
    for network in ("standing", "flying", "at_1_mbps"):
        ratio = ns[f"{network}/10000"] / ns[f"{network}/100"]
        write(f"{network}_ratio", f"{ratio:.2f}")
    of_networks = ns["standing_in_100_networks/100/min_time:2.000"] / ns["standing/10000"]
    write("networks_ratio", f"{of_networks:.2f}")
    line = results["dependent_lines/8000000"]
    write("dependent_line", f"{line['cpu_time']:.0f}", line["time_unit"])


if __name__ == "__main__":
    main(Path(sys.argv[1]))
