"""Tests that need the compiled part."""

import pytest

pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")
