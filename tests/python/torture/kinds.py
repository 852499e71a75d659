"""Kinds of faults of `make torture`, and of the short tests."""

import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from random import Random

from python.torture import clients, damage, faults, kills, mutants, readers, scenarios, signals, states

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

if sys.platform == "linux" and shutil.which("cc"):
    KINDS["faults of the disk"] = faults.ONCE
    KINDS["faults in a sequence"] = {"run, pack, unpack": states.once}
