"""From the nodes of a scenario to the autopilots that fly them."""

import os
import sys

import pytest

from gradysim.scenario.errors import ConfigError
from gradysim.sitl.mavlink import load_dialect
from gradysim.sitl.scenario_autopilots import check_autopilots

TESTED = "class Tested(Quiet): pass"


@pytest.mark.parametrize(
    ("settings", "key", "value"),
    [
        (['*.uavs[0].mobility.autopilotPath = "nothing"'], "autopilotPath", "nothing"),
        (["*.uavs[0].mobility.initialZ = -5m"], "typename", "z = -5 m"),
        (['*.uavs[0].mobility.autopilotUser = "nosuchuser"'], "autopilotUser", "'nosuchuser'"),
        (
            ["*.coordinateSystem.sceneLatitude = 90deg", "*.uavs[0].mobility.initialY = 5m"],
            "typename",
            "(90.0, 0.0, 0.0)",
        ),
        (
            ['*.uavs[0].mobility.autopilotParameters = "SIM_WIND_TURB=1"'],
            "autopilotParameters",
            "SIM_WIND_TURB",
        ),
    ],
)
def test_a_node_that_cannot_be_flown_is_refused_before_anything_runs(flown_scenario, settings, key, value):
    with pytest.raises(ConfigError) as caught:
        check_autopilots(flown_scenario(TESTED, *settings))
    assert caught.value.key == f"*.uavs[0].mobility.{key}"
    assert value in caught.value.message


def test_a_wrong_parameter_is_told_with_the_line_that_has_it(flown_scenario):
    scenario = flown_scenario(TESTED, '*.uavs[0].mobility.autopilotParameters = "SIM_WIND_TURB=1"')
    autopilot = scenario.nodes[0].autopilot
    assert autopilot.parameters_source != autopilot.source
    with pytest.raises(ConfigError) as caught:
        check_autopilots(scenario)
    assert caught.value.source == autopilot.parameters_source


def test_a_protocol_of_the_engine_obeys_no_autopilot(flown_scenario):
    scenario = flown_scenario(TESTED, '*.uavs[*].protocol.typename = "BeaconProtocol"')
    with pytest.raises(ConfigError) as caught:
        check_autopilots(scenario)
    assert caught.value.source == scenario.nodes[0].autopilot.source


def test_without_pymavlink_the_error_says_what_to_install(flown_scenario, monkeypatch):
    load_dialect.cache_clear()
    monkeypatch.setitem(sys.modules, "pymavlink.dialects.v20.ardupilotmega", None)
    with pytest.raises(ConfigError, match=r"pip.*pymavlink"):
        check_autopilots(flown_scenario(TESTED))


def test_the_environment_without_an_autopilot(make_scenario, monkeypatch):
    monkeypatch.delenv("GRADYSIM_ARDUPILOT", raising=False)
    monkeypatch.setenv("PATH", os.devnull)
    with pytest.raises(ConfigError, match="GRADYSIM_ARDUPILOT"):
        check_autopilots(make_scenario(TESTED, '*.uavs[0].mobility.typename = "ArdupilotMobility"'))
