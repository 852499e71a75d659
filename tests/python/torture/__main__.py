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
    done: Counter[str] = Counter()
    failures: Counter[str] = Counter()
    spent_s = dict.fromkeys(KINDS, 0.0)
    end_s = time.monotonic() + 60 * minutes
    while (begin_s := time.monotonic()) < end_s:
        kind = min(KINDS, key=lambda kind: spent_s[kind])
        times, lost = harm(KINDS[kind], seeds.randrange(2**32))
        done[kind] += times
        spent_s[kind] += time.monotonic() - begin_s
        if lost:
            failures[kind] += 1
            if failures[kind] == 1:  # the others are often the same
                print(f"{kind}: {lost}", file=sys.stderr)
    table = Table("harm", "times", "lost")
    for kind in KINDS:
        table.add_row(kind, f"{done[kind]:,}", f"{failures[kind]:,}" if failures[kind] else "nothing")
    Console().print(table)
    return 1 if failures.total() else 0


if __name__ == "__main__":
    sys.exit(main(float(sys.argv[1])))
