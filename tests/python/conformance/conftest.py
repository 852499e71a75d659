"""Lets the tests of this folder import what they share, `scripted.py`."""

import sys
from pathlib import Path

import pytest

pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")

sys.path.insert(0, str(Path(__file__).parent))
