"""Studies of many runs: they start at once, and a run costs no more than in a small study."""

import subprocess
import sys

import pytest

from gradysim.cli.errors import FAILED

INI = """
[General]
sim-time-limit = 1s
*.numUavs = 10
*.uavs[*].protocol.class = "protocol.py:Failing"
*.uavs[*].mobility.speed = ${speed=1..10}mps
*.uavs[*].mobility.lineStepX = ${step=1..10}m
*.uavs[*].mobility.lineStepY = ${other=1..10}m
repeat = 100
"""

PROTOCOL = """
from gradysim.protocol.interface import IProtocol


class Failing(IProtocol):
    def initialize(self): raise RuntimeError("spoilt")
    def handle_timer(self, timer): pass
    def handle_packet(self, message): pass
    def handle_telemetry(self, telemetry): pass
    def finish(self): pass
"""

MOST_MEMORY = 200e6

MEASURED = """
import resource, subprocess, sys
done = subprocess.run([sys.executable, "-m", "gradysim", "run", "study.ini"])
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(used.ru_utime, used.ru_maxrss)
sys.exit(done.returncode)
"""


@pytest.mark.verify
def test_a_study_of_100_000_runs_reaches_its_first_run_with_little_memory(tmp_path):
    (tmp_path / "study.ini").write_text(INI)
    (tmp_path / "protocol.py").write_text(PROTOCOL)
    # From a small process, since a new process counts with the memory of the one that it is forked from.
    done = subprocess.run([sys.executable, "-c", MEASURED], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == FAILED
    cpu_s, most_kb = map(float, done.stdout.splitlines()[-1].split())
    assert done.stderr.count("spoilt") == 1
    assert "(1..99999)" in done.stderr
    assert cpu_s < 10  # checking all runs took minutes
    assert most_kb * 1024 < MOST_MEMORY
