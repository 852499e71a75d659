"""The directory of the scripts on the import path, as when they are started from it."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[4] / "examples" / "paper"))
