"""Nodes that a script changes."""

from dataclasses import replace
from typing import Any

import pytest

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.node.node_spec import NodeSpec
from python.quiet_protocol import Quiet

SPEC = NodeSpec(0, "uavs[0]", "uavs", 0, IProtocol, {}, (0, 0, 0), {})


@pytest.mark.parametrize("wrong", ["survey.py:Sensor", None])
def test_a_protocol_that_is_no_class(wrong: Any) -> None:
    with pytest.raises(TypeError, match=r"the protocol of uavs\[0\] must be a class, got"):
        replace(SPEC, protocol=wrong)


@pytest.mark.parametrize("wrong", [(1, 2), (float("nan"), 0, 0), "123", None])
def test_a_position_that_is_none(wrong: Any) -> None:
    with pytest.raises(ValueError, match=r"the position of uavs\[0\] must be three finite numbers"):
        replace(SPEC, initial_position=wrong)


def test_a_position_of_whole_numbers_becomes_one_of_floats() -> None:
    place = replace(SPEC, initial_position=[1, 2, 3]).initial_position  # type: ignore[arg-type]
    assert (place, {type(number) for number in place}) == ((1.0, 2.0, 3.0), {float})


@pytest.mark.parametrize(
    ("name", "hint"), [("jiter", r"; did you mean `jitter`\?"), ("provider", ""), ("handle_timer", "")]
)
def test_a_parameter_that_the_protocol_has_not(name: str, hint: str) -> None:
    class Jittered(Quiet):
        jitter = 0.0

    with pytest.raises(
        ValueError, match=rf"`{name}` is no parameter of Jittered, the protocol of uavs.*{hint}"
    ):
        replace(SPEC, protocol=Jittered, protocol_parameters={name: 1.0})


def test_an_attribute_of_any_kind_that_the_protocol_has() -> None:
    class Thinking(Quiet):
        policy = None
        jitter: float

    parameters = {"policy": object(), "jitter": 0.5}
    assert replace(SPEC, protocol=Thinking, protocol_parameters=parameters).protocol_parameters == parameters
