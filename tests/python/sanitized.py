"""Plugin of pytest for `make test-binding`: the engine in `build/binding`, which has sanitizers.

Commands in processes of their own use the installed engine.
"""

import importlib.util
import sys
from pathlib import Path

(_FILE,) = Path(__file__).parents[2].glob("build/binding/_netsim.*")
_SPEC = importlib.util.spec_from_file_location("gradysim._netsim", _FILE)
assert _SPEC is not None
assert _SPEC.loader is not None
sys.modules["gradysim._netsim"] = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(sys.modules["gradysim._netsim"])
