"""`make torture MINUTES=20`: injects faults of all kinds in turn, and prints what was lost.

The short tests do the same a few times. Each kind of fault is a module here with a function `once`.
"""

import sys
import tempfile
import time
import traceback
from collections import Counter
from pathlib import Path
from random import Random, SystemRandom

from rich.console import Console
from rich.table import Table

from python.torture.kinds import KINDS, Once


def harm(once: Once, seed: int) -> tuple[int, str]:
    """Inject a fault once. Return how often, and what was lost."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            return once(Random(seed), Path(folder)), ""
        except Exception:
            return 1, f"seed {seed}: {traceback.format_exc()}"


def main(minutes: float) -> int:
    """Inject faults of all kinds in turn, and print a table.

    Return the exit code: 1 if something was lost.
    """
    seeds = SystemRandom()
    done: Counter[tuple[str, str]] = Counter()
    failures: Counter[tuple[str, str]] = Counter()
    spent_s: Counter[str] = Counter()
    end_s = time.monotonic() + 60 * minutes
    while (begin_s := time.monotonic()) < end_s:
        kind = min(KINDS, key=lambda kind: spent_s[kind] / len(KINDS[kind]) ** 0.5)
        harmed = min(KINDS[kind], key=lambda harmed: done[kind, harmed])
        times, lost = harm(KINDS[kind][harmed], seeds.randrange(2**32))
        done[kind, harmed] += times
        spent_s[kind] += time.monotonic() - begin_s
        if lost:
            failures[kind, harmed] += 1
            if failures[kind, harmed] == 1:  # the others are often the same
                print(f"{kind}, {harmed}: {lost}", file=sys.stderr)
    table = Table("kind", "harmed", "times", "lost")
    for kind, several in KINDS.items():
        for harmed in several:
            lost_times = failures[kind, harmed]
            table.add_row(
                kind, harmed, f"{done[kind, harmed]:,}", f"{lost_times:,}" if lost_times else "nothing"
            )
    Console().print(table)
    return 1 if failures.total() else 0


if __name__ == "__main__":
    sys.exit(main(float(sys.argv[1])))
