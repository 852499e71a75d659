"""State that protocols leave in classes and modules, and late imports."""

import json

import pytest

from python.cli.command import both_modes, compiled

NUMBERED = """
import itertools
from protocol import Talker
from numbered_beside import taken


class Numbered(Talker):
    numbers = itertools.count()

    def initialize(self):
        super().initialize()
        taken.append(next(self.numbers))
        self.provider.tracked_variables["taken"] = list(taken)
"""

LATE = """
from protocol import Talker


class Late(Talker):
    def finish(self):
        from numbered_beside import taken
        import pickle
        from beside_late import Place

        self.provider.tracked_variables["late"] = pickle.loads(pickle.dumps(Place(taken))).taken
"""


@pytest.fixture
def beside(folder):
    (folder / "numbered_beside.py").write_text("taken = []")
    (folder / "numbered.py").write_text(NUMBERED)
    (folder / "late.py").write_text(LATE)
    (folder / "beside_late.py").write_text(
        "class Place:\n    def __init__(self, taken):\n        self.taken = [*taken, 1]\n"
    )
    return folder


@both_modes
@pytest.mark.parametrize("options", [(), ("--jobs", "2"), ("--runs", "2")])
def test_a_run_does_not_depend_on_those_before_it(gradysim, beside, mode, options):
    protocol = ("--set", '*.uavs[*].protocol.class="numbered.py:Numbered"', "--set", "*.uavs.count=2")
    done = gradysim("run", "test.ini", "--mode", mode, "--json", *protocol, *options)
    runs = [json.loads(line) for line in done.stdout.splitlines()]
    assert {run["run"] for run in runs} == ({2} if "--runs" in options else {0, 1, 2})
    for run in runs:
        last = [node for node in run["nodes"] if node["name"].startswith("uavs")][-1]
        assert last["tracked_variables"]["taken"] == [0, 1], run["run"]


@compiled
def test_a_run_of_such_protocols_and_native_ones_does_not_either(gradysim, beside):
    lines = ('*.uavs[*].protocol.class="numbered.py:Numbered"', '*.beacon.protocol.typename="BeaconProtocol"')
    settings = [part for line in lines for part in ("--set", line)]
    done = gradysim("run", "test.ini", "--json", "-r", "0,1", *settings)
    runs = [json.loads(line) for line in done.stdout.splitlines()]
    assert [run["nodes"][1]["tracked_variables"]["taken"] for run in runs] == [[0, 1], [0, 1]]


@both_modes
def test_what_lies_beside_a_protocol_can_be_imported_late(gradysim, beside, mode):
    protocol = ("--set", '*.uavs[*].protocol.class="late.py:Late"')
    done = gradysim("run", "test.ini", "--mode", mode, "--json", *protocol)
    assert done.returncode == 0, done.stderr
    for line in done.stdout.splitlines():
        uav = next(node for node in json.loads(line)["nodes"] if node["name"].startswith("uavs"))
        assert uav["tracked_variables"]["late"] == [1]
