"""Import path of the shared modules of this directory, such as `scripted.py`."""

import sys
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")

sys.path.insert(0, str(Path(__file__).parent))
