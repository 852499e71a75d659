import os
import subprocess
import sys
from pathlib import Path

import pytest

from gradysim.sitl.dialect import load_dialect


def test_it_writes_version_2():
    mavlink = load_dialect()
    codec = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
    assert mavlink.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3).pack(codec)[0] == 0xFD


def test_without_pymavlink_it_says_what_to_install(monkeypatch):
    load_dialect.cache_clear()
    monkeypatch.setitem(sys.modules, "pymavlink.dialects.v20.ardupilotmega", None)
    with pytest.raises(ModuleNotFoundError, match="pip install pymavlink"):
        load_dialect()


def test_pymavlink_is_imported_only_when_it_is_needed():
    program = "import gradysim.simulator.handler.ardupilot_mobility, sys; print('pymavlink' in sys.modules)"
    package = Path(__file__).parents[3] / "python"
    outcome = subprocess.run(
        [sys.executable, "-c", program],
        env=os.environ | {"PYTHONPATH": str(package)},
        capture_output=True,
        text=True,
        check=True,
    )
    assert outcome.stdout == "False\n"
