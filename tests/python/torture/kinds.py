"""Kinds of faults of `make torture`, and of the short tests."""

import sys
from collections.abc import Callable
from pathlib import Path
from random import Random

from python.torture import clients, damage, faults, kills, mutants, readers, scenarios, signals

Once = Callable[[Random, Path], int]
"""Injects faults in an empty directory, and returns how often. An exception says what was lost."""

KINDS: dict[str, dict[str, Once]] = {
    "changed files": {"ini": mutants.once, **readers.ONCE},
    "random scenarios": {"run, twice": scenarios.once},
    "hostile clients": {"view": clients.once},
    "kills": {"run": kills.once},
    "signals": {"run": signals.once},
    "damaged packs": {"all that read packs": damage.once},
}
"""{kind of fault: {what it harms: function}}"""

if sys.platform == "linux":
    KINDS["faults of the disk"] = faults.ONCE
