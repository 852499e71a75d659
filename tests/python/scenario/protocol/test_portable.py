"""Classes that go to other processes, here and in processes that know nothing of them."""

import pickle
from concurrent.futures import ProcessPoolExecutor
from copy import deepcopy
from dataclasses import replace
from multiprocessing import get_context
from typing import Any

import pytest

from gradysim.prototype.run import run
from gradysim.scenario import Scenario, load_scenarios
from gradysim.scenario.protocol.loader import ProtocolLoader
from gradysim.scenario.protocol.native import native_protocol
from gradysim.scenario.protocol.origin import Origin, origin_of
from gradysim.scenario.protocol.portable import class_from, portable
from python.quiet_protocol import Quiet

NODES = """[General]
sim-time-limit = 2s
repeat = 2
*.numUavs = 3
*.uavs[*].protocol.class = "shared.py:Counting"
*.boat.protocol.class = "shared.py:Other"
"""
SHARED = """
from protocols import Sensor

created = []


class Counting(Sensor):
    def initialize(self):
        created.append(self)
        self.provider.tracked_variables["number"] = len(created)


class Other(Counting):
    pass
"""


@pytest.fixture
def scenarios(folder: Any) -> list[Scenario]:
    folder.write("shared.py", SHARED)
    folder.write("test.ini", NODES)
    return load_scenarios(folder.ini)


def of_another_process(cls: type) -> type:
    """What another process makes of the class."""
    origin = portable(cls)
    assert isinstance(origin, Origin)
    return class_from(replace(origin, load=f"that of {origin.load}"))


def numbers(scenario: Scenario) -> tuple[set[type], list[Any]]:
    """The classes of the UAVs, and what all nodes count in a run."""
    classes = {node.protocol for node in scenario.nodes[:3]}
    return classes, [node.tracked_variables["number"] for node in run(scenario).nodes]


def run_elsewhere(scenario: Scenario) -> tuple[int, list[Any]]:
    classes, counted = numbers(scenario)
    return len(classes), counted


def test_a_class_stays_itself_in_its_process_also_if_its_file_was_loaded_again(
    scenarios: list[Scenario], folder: Any
) -> None:
    load_scenarios(folder.ini)
    for copied in (pickle.loads(pickle.dumps(scenarios[0])), deepcopy(scenarios[0])):
        assert copied == scenarios[0]
        assert copied.nodes[0].protocol is scenarios[0].nodes[0].protocol


def test_scenarios_run_in_processes_that_begin_anew(scenarios: list[Scenario]) -> None:
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        first, second = pool.map(run_elsewhere, scenarios)
    assert (first, second) == ((1, [1, 2, 3, 4]), (1, [5, 6, 7, 8]))


def test_elsewhere_classes_of_a_file_share_their_module_as_here(scenarios: list[Scenario]) -> None:
    uav, boat = (of_another_process(scenarios[0].nodes[index].protocol) for index in (0, 3))
    assert uav is not scenarios[0].nodes[0].protocol
    assert boat.__mro__[1] is uav
    assert uav is of_another_process(scenarios[1].nodes[1].protocol)


def test_a_class_of_an_imported_file_comes_from_the_one_that_was_named(folder: Any) -> None:
    named = folder.write("named.py", "from protocols import Mobile as Drone")
    cls = ProtocolLoader().load("named.py:Drone", folder.path)
    origin = origin_of(cls)
    assert origin is not None
    assert (origin.file, origin.name) == (named, "Drone")
    assert of_another_process(cls).__name__ == "Mobile"


def test_a_class_of_a_module_goes_by_its_name() -> None:
    assert portable(Quiet) is Quiet
    assert class_from(Quiet) is Quiet


def test_a_native_protocol_goes_by_its_name() -> None:
    beacon = native_protocol("BeaconProtocol")
    assert class_from(pickle.loads(pickle.dumps(portable(beacon)))) is beacon
