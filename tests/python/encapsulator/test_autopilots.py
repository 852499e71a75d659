"""The autopilots of a scenario, which are loaded only if it has nodes with one."""

import subprocess
import sys

from gradysim.encapsulator.autopilots import flights_of

WITHOUT_AUTOPILOTS = """
import sys
import gradysim.cli.run, gradysim.integrated, gradysim.prototype.run
print([name for name in sys.modules if name.startswith("gradysim.sitl")])
"""


def test_without_such_nodes_there_are_no_flights(make_scenario):
    assert flights_of(make_scenario()) is None


def test_the_modes_do_not_load_autopilots():
    loaded = subprocess.run([sys.executable, "-c", WITHOUT_AUTOPILOTS], capture_output=True, text=True)
    assert loaded.stdout == "[]\n"
