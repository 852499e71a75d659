"""What an .ini file says of the autopilot of a node."""

import pickle

import pytest

from gradysim.scenario.errors import ConfigError

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
        ("*.uavs[*].mobility.speed = 0mps", "too slow for an autopilot; expected at least 0.2mps"),
        ("*.uavs[*].mobility.speed = 0.1mps", "too slow for an autopilot; expected at least 0.2mps"),
        ('*.uavs[*].mobility.autopilotParameters = "A=1 B"', "`B` is no parameter; expected some as"),
        ('*.uavs[*].mobility.autopilotParameters = "A=fast"', "`A=fast` is no parameter"),
        ('*.uavs[*].mobility.autopilotParameters = "A=inf"', "`A=inf` is no parameter"),
        ('*.uavs[*].mobility.autopilotParameters = "=1"', "`=1` is no parameter"),
        (
            '*.uavs[*].mobility.autopilotParameters = "A=1 a=2"',
            "`a` comes twice; expected each parameter once",
        ),
    ],
)
def test_what_makes_no_sense_is_refused_with_its_line(make_scenario, line, said):
    with pytest.raises(ConfigError) as caught:
        make_scenario("class Tested(Talker): pass", FLOWN, line)
    assert said in str(caught.value)
    assert line.split(" ")[0] in str(caught.value)
