"""Kinds of faults of `make torture`, and of the short tests."""

import sys
from collections.abc import Callable
from pathlib import Path
from random import Random

from python.torture import clients, damage, faults, kills, mutants, scenarios, signals

Once = Callable[[Random, Path], int]
"""Injects faults in an empty directory, and returns how often. An exception says what was lost."""

KINDS: dict[str, Once] = {
    "mutated .ini files": mutants.once,
    "random scenarios, run twice": scenarios.once,
    "hostile clients": clients.once,
    "kills": kills.once,
    "signals": signals.once,
    "damaged packs": damage.once,
}
if sys.platform == "linux":
    KINDS["faults of the disk"] = faults.once
