import sys
from typing import Any

import pytest

from gradysim.scenario.errors import BadValue
from gradysim.scenario.protocol.native import NativeProtocol, native_protocol, text_of_only_integrated

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


def test_a_unit_of_something_else_is_refused_at_its_line(folder: Any) -> None:
    added = BEACONS + "*.uavs[*].protocol.interval = 5m\n"
    assert folder.error(added, "X").startswith(
        "test.ini:8: *.uavs[*].protocol.interval = 5m: `m` is the unit"
    )


def test_an_unknown_typename_is_an_error_with_the_nearest_name(folder: Any) -> None:
    text = folder.error(BEACONS.replace("BeaconProtocol", "Beacon"), "X")
    assert text.startswith("test.ini:7: ")
    assert text.endswith(
        "there is no native protocol `Beacon`; expected one that `gradysim keys protocol` lists; "
        "did you mean `BeaconProtocol`?"
    )


def test_a_class_as_typename_is_an_error_that_names_the_key_for_it(folder: Any) -> None:
    text = folder.error(BEACONS.replace("BeaconProtocol", "protocols.py:Mobile"), "X")
    assert text.endswith("; did you mean `protocol.class`?")


def test_a_typename_as_class_is_an_error_that_names_the_key_for_it(folder: Any) -> None:
    text = folder.error(BEACONS.replace("typename", "class"), "X")
    assert text.endswith("; did you mean `protocol.typename`?")


def test_an_unknown_parameter_is_an_error_with_the_nearest_name(folder: Any) -> None:
    text = folder.error(BEACONS + "*.uavs[*].protocol.intervall = 1s\n", "X")
    assert text.startswith("test.ini:8: `intervall` is not a parameter of BeaconProtocol; expected one of ")
    assert text.endswith("did you mean `*.uavs[*].protocol.interval`?")


def test_a_value_of_another_kind_is_an_error(folder: Any) -> None:
    text = folder.error(BEACONS + "*.uavs[*].protocol.payload_bytes = 1.5\n", "X")
    assert "`1.5` is no whole number; expected a whole number" in text


def test_a_misspelt_typename_is_an_error(folder: Any) -> None:
    text = folder.error('[X]\n*.uavs[*].protocol.typenam = "BeaconProtocol"\n', "X")
    assert text.endswith("did you mean `*.uavs[*].protocol.typename`?")


def test_without_the_compiled_part_there_are_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "gradysim.integrated.native_protocols", None)
    with pytest.raises(BadValue, match=r"native protocols are the engine's: .*"):
        native_protocol("BeaconProtocol")


def test_nothing_runs_in_it() -> None:
    protocol = native_protocol("BeaconProtocol")()
    with pytest.raises(RuntimeError, match=r"BeaconProtocol does not run in here"):
        protocol.initialize()


def test_without_a_counterpart_in_python_only_the_mode_is_named() -> None:
    class Own(NativeProtocol):
        pass

    text = "the native protocol Own does not run in prototype mode; use integrated mode"
    assert text_of_only_integrated(Own, "prototype mode") == text
