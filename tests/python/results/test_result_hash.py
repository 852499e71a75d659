import dataclasses
import json
from typing import Any

import pytest

from gradysim.results.delays import constant_delays
from gradysim.results.result import NodeResult, RunResult
from gradysim.results.result_hash import result_hash

NODE = NodeResult(0, "uavs[0]", "Mobile", (1.0, 2.0, 3.0), {"heard": 1})
RESULT = RunResult(
    config="General",
    run=2,
    seed=7,
    mode="integrated",
    sim_time_s=10.0,
    wall_s=0.5,
    cpu_s=0.4,
    events=1000,
    interrupted=False,
    fingerprint="f",
    outcomes={"messages": {"broadcast": {"sent": 3}}},
    nodes=(NODE,),
)


def with_node(**changes: Any) -> RunResult:
    return dataclasses.replace(RESULT, nodes=(dataclasses.replace(NODE, **changes),))


@pytest.mark.parametrize(
    "other",
    [
        dataclasses.replace(RESULT, sim_time_s=11.0),
        dataclasses.replace(RESULT, fingerprint="g"),
        dataclasses.replace(RESULT, outcomes={"messages": {"broadcast": {"sent": 4}}}),
        dataclasses.replace(RESULT, message_delays={"unicast": constant_delays({0.5: 2})}),
        dataclasses.replace(RESULT, nodes=(NODE, NODE)),
        with_node(position=(1.0, 2.0, 3.0000000000000004)),
        with_node(tracked_variables={"heard": 2}),
        with_node(frames_by_bitrate={6_000_000: 1}),
    ],
)
def test_whatever_the_run_computed_changes_it(other: RunResult) -> None:
    assert other.result_hash != RESULT.result_hash


@pytest.mark.parametrize(
    "same",
    [
        dataclasses.replace(RESULT, wall_s=9.0, cpu_s=9.0, setup_s=9.0),
        dataclasses.replace(RESULT, run=3, settings_hash="a"),
        with_node(protocol="MobileProtocol"),
        with_node(frame_outcomes={}, interferers={}, message_outcomes={}, vectors=()),
    ],
)
def test_its_cost_its_names_and_what_was_asked_for_do_not(same: RunResult) -> None:
    assert same.result_hash == RESULT.result_hash


def test_an_object_counts_without_its_address() -> None:
    one, other = (with_node(tracked_variables={"mate": object()}) for _ in range(2))
    assert one.result_hash == other.result_hash


def test_it_follows_from_the_file_of_the_result() -> None:
    told = json.loads(json.dumps(RESULT.to_json_object()))
    assert result_hash(told) == told["result_hash"] == RESULT.result_hash
