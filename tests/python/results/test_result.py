import dataclasses
import json

import pytest

from gradysim.results.delays import constant_delays
from gradysim.results.result import NodeResult, RunResult


def result_with(tracked_variables):
    node = NodeResult(0, "uavs[0]", "Mobile", (1.0, 2.0, 3.0), tracked_variables)
    return RunResult(
        config="General",
        run=2,
        seed=7,
        mode="prototype",
        sim_time_s=10.0,
        wall_s=0.5,
        cpu_s=0.4,
        events=1000,
        interrupted=False,
        fingerprint=None,
        outcomes={"messages": {"broadcast": {"delivered": 3}}},
        nodes=(node,),
        repetition=1,
        iterations={"jitter": "10ms", "nodes": "5", "alpha": "2.5", "name": '"a"', "noise": "nan"},
        settings_hash="0123",
    )


def test_keys_and_values_that_scripts_rely_on():
    result = result_with({}).to_json_object()
    del result["nodes"]
    assert list(result.items()) == [
        ("config", "General"),
        ("run", 2),
        ("seed", 7),
        ("mode", "prototype"),
        ("sim_time_s", 10.0),
        ("wall_s", 0.5),
        ("cpu_s", 0.4),
        ("events", 1000),
        ("interrupted", False),
        ("fingerprint", None),
        ("outcomes", {"messages": {"broadcast": {"delivered": 3}}}),
        ("message_delays", {}),
        ("repetition", 1),
        ("iterations", {"jitter": "10ms", "nodes": 5, "alpha": 2.5, "name": "a", "noise": "nan"}),
        ("settings_hash", "0123"),
        ("file_hashes", {}),
        ("range_m", None),
        ("setup_s", 0.0),
        ("result_hash", result_with({}).result_hash),
    ]


@pytest.mark.parametrize("value", ["1" * 400, "2026_11", "-", "1-2", '"a" + "b"'])
def test_what_is_no_plain_number_stays_a_text(value):
    result = dataclasses.replace(result_with({}), iterations={"key": value})
    assert result.to_json_object()["iterations"] == {"key": value}


def test_a_text_is_told_as_protocols_read_it():
    result = dataclasses.replace(result_with({}), iterations={"key": r'"c\"d\n"'})
    assert result.to_json_object()["iterations"] == {"key": 'c"d\n'}


def test_every_field_of_a_node_is_told_but_its_vectors():
    node = NodeResult(
        *(0, "uavs[0]", "Mobile", (1.0, 2.0, 3.0), {"x": 1}),
        frames_by_bitrate={1: 2},
        frame_outcomes={},
        interferers={},
        message_outcomes={},
        vectors=(),
    )
    given = {field.name for field in dataclasses.fields(node) if getattr(node, field.name) is not None}
    assert given == {field.name for field in dataclasses.fields(node)}
    assert given - node.to_json_object().keys() == {"vectors"}


def test_delays_are_told_by_kind():
    result = dataclasses.replace(result_with({}), message_delays={"unicast": constant_delays({0.5: 2})})
    told = result.to_json_object()["message_delays"]
    assert told == {"unicast": constant_delays({0.5: 2}).to_json_object()}


def test_keys_of_a_node():
    (node,) = json.loads(json.dumps(result_with({"packets": 5}).to_json_object()))["nodes"]
    assert node == {
        "id": 0,
        "name": "uavs[0]",
        "protocol": "Mobile",
        "position": [1.0, 2.0, 3.0],
        "tracked_variables": {"packets": 5},
    }


def test_frames_by_bitrate_are_there_if_there_were_any():
    node = NodeResult(
        0, "uavs[0]", "Mobile", (0.0, 0.0, 0.0), {}, frames_by_bitrate={24_000_000: 3, 6_000_000: 1}
    )
    assert node.to_json_object()["frames_by_bitrate"] == {"24000000": 3, "6000000": 1}


def test_outcomes_and_interferers_are_there_if_the_run_was_asked_for_them():
    heard = {"broadcast": {"delivered": 3}}
    said = {"wlan[0]": {"broadcast": {"sent": 5}}, "wlan[1]": {}}
    node = NodeResult(
        *(0, "uavs[0]", "Mobile", (0.0, 0.0, 0.0), {}),
        frame_outcomes=heard,
        interferers={},
        message_outcomes=said,
    )
    told = node.to_json_object()
    assert (told["frame_outcomes"], told["interferers"], told["message_outcomes"]) == (heard, {}, said)


def test_a_tracked_variable_without_a_json_form_is_given_as_repr():
    (node,) = json.loads(json.dumps(result_with({"seen": {4}}).to_json_object()))["nodes"]
    assert node["tracked_variables"] == {"seen": "{4}"}
