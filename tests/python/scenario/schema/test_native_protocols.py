import pickle
import sys
from typing import Any

import pytest

from gradysim.scenario.errors import BadValue, ConfigError
from gradysim.scenario.schema.native_protocols import (
    is_native_name,
    native_protocol,
    native_protocols,
)

pytest.importorskip("gradysim._netsim", reason="the compiled part is not installed")

NATIVE = '*.uavs[*].protocol.typename = "BeaconProtocol"\n[X]\n'
BEACONS = '[X]\n*.uavs[*].protocol.typename = "BeaconProtocol"\n'


def protocols(scenario: Any) -> list[str]:
    return [node.protocol.__name__ for node in scenario.nodes]


def test_a_typename_of_a_more_specific_section_wins_over_a_class(folder: Any) -> None:
    assert protocols(folder.load(BEACONS, "X")) == ["Sensor", "BeaconProtocol", "BeaconProtocol"]


def test_of_typename_and_class_the_first_in_the_file_wins(folder: Any) -> None:
    assert protocols(folder.load(NATIVE)) == ["Sensor", "Mobile", "Mobile"]


def test_a_default_leaves_the_choice_to_the_other_key(folder: Any) -> None:
    added = BEACONS.replace("[X]\n", "[X]\n*.uavs[*].protocol.class = default\n")
    assert protocols(folder.load(added, "X"))[1] == "BeaconProtocol"


def test_a_typename_alone_makes_a_single_node(folder: Any) -> None:
    assert protocols(folder.load('*.beacon.protocol.typename = "BeaconProtocol"\n'))[-1] == "BeaconProtocol"


def test_its_parameters_are_checked_and_converted(folder: Any) -> None:
    added = BEACONS + "*.uavs[*].protocol.interval = 100ms\n*.uavs[*].protocol.payload_bytes = 7\n"
    node = folder.load(added, "X").nodes[1]
    assert node.protocol_parameters == {"interval": 0.1, "payload_bytes": 7}
    assert node.protocol_sources["interval"].line == 8
    assert node.protocol_sources[""].key == "*.uavs[*].protocol.typename"


@pytest.mark.parametrize(
    ("lines", "line", "hint"),
    [
        (f"{BEACONS}*.uavs[*].protocol.interval = 5m\n", 8, "`min`"),
        (f"{BEACONS}*.uavs[*].protocol.intervall = 1s\n", 8, "`*.uavs[*].protocol.interval`"),
        (f"{BEACONS}*.uavs[*].protocol.payload_bytes = 1.5\n", 8, "`1.5`"),
        (BEACONS.replace("BeaconProtocol", "Beacon"), 7, "`BeaconProtocol`?"),
        (BEACONS.replace("BeaconProtocol", "protocols.py:Mobile"), 7, "`protocol.class`?"),
        (BEACONS.replace("typename", "class"), 7, "`protocol.typename`?"),
        (BEACONS.replace("typename", "typenam"), 7, "`*.uavs[*].protocol.typename`?"),
    ],
)
def test_an_error_has_its_line_and_a_hint(folder: Any, lines: str, line: int, hint: str) -> None:
    with pytest.raises(ConfigError) as error:
        folder.load(lines, "X")
    assert error.value.line == line
    assert hint in error.value.message


def test_without_the_compiled_part_there_are_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "gradysim._netsim", None)
    native_protocols.cache_clear()
    with pytest.raises(BadValue):
        native_protocol("BeaconProtocol")
    assert not is_native_name("BeaconProtocol")


def test_pickle_finds_the_class_by_its_name() -> None:
    beacon = native_protocol("BeaconProtocol")
    assert pickle.loads(pickle.dumps(beacon)) is beacon


def test_nothing_runs_in_it() -> None:
    protocol = native_protocol("BeaconProtocol")()
    with pytest.raises(RuntimeError):
        protocol.initialize()
