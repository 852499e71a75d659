"""Autopilot settings of a node in an .ini file."""

import pickle
from dataclasses import fields, replace
from typing import Any

import pytest

from gradysim.protocol.interface import IProtocol
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.node_spec import STRUCTS, InterfaceSpec, NodeSpec
from python.quiet_protocol import Quiet


def test_all_mappings_are_structs() -> None:
    """A missing one would not be read from a file, and not be reported as unread."""
    assert list(STRUCTS) == [field.name for field in fields(InterfaceSpec) if field.default_factory is dict]


FLOWN = '*.uavs[0].mobility.typename = "ArdupilotMobility"'


def test_a_node_without_one(make_scenario):
    assert make_scenario().nodes[0].autopilot is None


def test_the_defaults(make_scenario):
    flown, other = make_scenario("class Tested(Talker): pass", FLOWN).nodes
    spec = flown.autopilot
    assert (spec.program, spec.user, spec.speed_mps, spec.parameters) == (None, "nobody", 10, {})
    assert spec.source.value == '"ArdupilotMobility"'
    assert flown.mobility["typename"].value == "MasslessMobility"
    assert other.autopilot is None


def test_all_of_it(make_scenario, tmp_path):
    scenario = make_scenario(
        "class Tested(Talker): pass",
        FLOWN,
        '*.uavs[*].mobility.autopilotPath = "here/arducopter"',
        '*.uavs[*].mobility.autopilotUser = ""',
        "*.uavs[*].mobility.speed = 36kmph",
        '*.uavs[*].mobility.autopilotParameters = "wpnav_speed_up=250, SIM_WIND_SPD=8.5 X_1=-1e2"',
    )
    spec = scenario.nodes[0].autopilot
    assert spec.program == str(tmp_path / "here/arducopter")
    assert spec.user is None
    assert spec.speed_mps == pytest.approx(10)
    assert spec.parameters == {"WPNAV_SPEED_UP": 250, "SIM_WIND_SPD": 8.5, "X_1": -100}
    assert pickle.loads(pickle.dumps(scenario)).nodes[0].autopilot == spec


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("*.uavs[*].mobility.speed = 0mps", " 0.2mps"),
        ("*.uavs[*].mobility.speed = 0.1mps", " 0.2mps"),
        ('*.uavs[*].mobility.autopilotParameters = "A=1 B"', "`B`"),
        ('*.uavs[*].mobility.autopilotParameters = "A=fast"', "`A=fast`"),
        ('*.uavs[*].mobility.autopilotParameters = "A=inf"', "`A=inf`"),
        ('*.uavs[*].mobility.autopilotParameters = "=1"', "`=1`"),
        ('*.uavs[*].mobility.autopilotParameters = "A=1 a=2"', "`a`"),
    ],
)
def test_what_makes_no_sense_is_refused_with_its_line(make_scenario, line, said):
    with pytest.raises(ConfigError) as caught:
        make_scenario("class Tested(Talker): pass", FLOWN, line)
    assert said in str(caught.value)
    assert line.split(" ")[0] in str(caught.value)


SPEC = NodeSpec(0, "uavs[0]", "uavs", 0, IProtocol, {}, (0, 0, 0), {})


@pytest.mark.parametrize("wrong", ["survey.py:Sensor", None])
def test_a_protocol_that_is_no_class(wrong: Any) -> None:
    with pytest.raises(TypeError, match=r"protocol .*uavs\[0\] "):
        replace(SPEC, protocol=wrong)


@pytest.mark.parametrize("wrong", [(1, 2), (float("nan"), 0, 0), "123", None])
def test_a_position_that_is_none(wrong: Any) -> None:
    with pytest.raises(ValueError, match=r"position .*uavs\[0\] "):
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

    with pytest.raises(ValueError, match=rf"^`{name}` .* Jittered, .* uavs.*{hint}"):
        replace(SPEC, protocol=Jittered, protocol_parameters={name: 1.0})


def test_an_attribute_of_any_kind_that_the_protocol_has() -> None:
    class Thinking(Quiet):
        policy = None
        jitter: float

    parameters = {"policy": object(), "jitter": 0.5}
    assert replace(SPEC, protocol=Thinking, protocol_parameters=parameters).protocol_parameters == parameters
