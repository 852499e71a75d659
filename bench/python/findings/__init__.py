"""Record of measured figures, docs/verification/findings.csv, which pages cite by id.

`make verify` and `make bench` write it. In a page, `0.11 s<!-- finding: beacons_native.200 -->` cites
a finding by its id, and tests/python/house/test_findings.py compares the two.
"""

import csv
import os
import platform
import subprocess
from datetime import date
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
FILE = ROOT / "docs" / "verification" / "findings.csv"
COLUMNS = ("id", "value", "unit", "commit", "machine", "date", "command")


def recorded(file: Path = FILE) -> dict[str, dict[str, str]]:
    """Return the rows of the record by id."""
    with file.open(encoding="utf-8", newline="") as lines:
        return {row["id"]: row for row in csv.DictReader(lines)}


def record(finding: str, value: object, unit: str, command: str, file: Path = FILE) -> None:
    """Write one finding. Other rows stay as they are."""
    rows = recorded(file)
    here = (_commit(), _machine(), date.today().isoformat())
    rows[finding] = dict(zip(COLUMNS, (finding, str(value), unit, *here, command), strict=True))
    with file.open("w", encoding="utf-8", newline="") as lines:
        writer = csv.DictWriter(lines, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows[each] for each in sorted(rows))


def _commit() -> str:
    """Return the commit, with a plus sign if the simulator has changed since."""
    git = ("git", "-C", str(ROOT))
    commit, changes = (
        subprocess.run([*git, *command], capture_output=True, text=True, check=True).stdout.strip()
        for command in (
            ("rev-parse", "--short", "HEAD"),
            ("status", "--porcelain", "cpp", "python", "configs"),
        )
    )
    return commit + "+" * bool(changes)


def _machine() -> str:
    """Return the processor and its number of cores."""
    cpuinfo = Path("/proc/cpuinfo")
    lines = cpuinfo.read_text(encoding="utf-8").splitlines() if cpuinfo.exists() else []
    models = [line.partition(": ")[2] for line in lines if line.startswith("model name")]
    return f"{(models or [platform.processor()])[0] or platform.machine()}, {os.cpu_count()} cores"
