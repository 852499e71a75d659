import logging
import re

import pytest

import gradysim.integrated.run
import gradysim.prototype.run
from gradysim.protocol.plugin.follow_mobility import (
    MobilityFollowerConfiguration,
    MobilityFollowerPlugin,
    MobilityLeaderConfiguration,
    MobilityLeaderPlugin,
)
from gradysim.protocol.plugin.mission_mobility import MissionMobilityConfiguration, MissionMobilityPlugin
from gradysim.protocol.plugin.random_mobility import RandomMobilityConfig, RandomMobilityPlugin
from gradysim.protocol.plugin.statistics import create_statistics
from python.quiet_protocol import Quiet


@pytest.mark.parametrize(
    ("plugin", "configuration"),
    [
        (MissionMobilityPlugin, MissionMobilityConfiguration),
        (RandomMobilityPlugin, RandomMobilityConfig),
        (MobilityLeaderPlugin, MobilityLeaderConfiguration),
        (MobilityFollowerPlugin, MobilityFollowerConfiguration),
    ],
)
@pytest.mark.parametrize("given", [{"speed": 5}, Quiet, 3])
def test_what_is_no_configuration_is_told_with_the_call_that_was_expected(plugin, configuration, given):
    call = f"expected `{plugin.__name__}(self, {configuration.__name__}(...))`, got {given!r}"
    with pytest.raises(TypeError, match=re.escape(call)):
        plugin(Quiet(), given)


def test_statistics_are_of_a_protocol():
    with pytest.raises(TypeError, match=r"'run'$"):
        create_statistics("run")


PLUGINS = {
    "MissionMobilityPlugin": "self.plugin.start_mission([(1, 0, 0), (2, 0, 0)])",
    "RandomMobilityPlugin": "self.plugin.initiate_random_trip()",
    "MobilityLeaderPlugin": "pass",
}


def warnings_of(mode, make_scenario, caplog, plugin, interval):
    python = f"""
from gradysim.protocol.plugin.follow_mobility import *
from gradysim.protocol.plugin.mission_mobility import *
from gradysim.protocol.plugin.random_mobility import *


class Flies(Quiet):
    other: int = 0

    def initialize(self):
        self.plugin = {plugin}(self)
        {PLUGINS[plugin]}
"""
    scenario = make_scenario(
        python,
        "*.numUavs = 3",
        '*.uavs[*].protocol.class = "protocols.py:Flies"',
        f"*.uavs[1..2].mobility.telemetryInterval = {interval}",
        "*.uavs[2].protocol.other = 1",
        "sim-time-limit = 1s",
    )
    caplog.clear()
    with caplog.at_level(logging.WARNING):
        mode.run(scenario)
    return [record.getMessage() for record in caplog.records if record.name.startswith("gradysim.protocol")]


@pytest.mark.parametrize("mode", [gradysim.integrated.run, gradysim.prototype.run])
@pytest.mark.parametrize("plugin", PLUGINS)
def test_nodes_without_telemetry_log_one_warning(mode, make_scenario, caplog, plugin):
    (warning,) = warnings_of(mode, make_scenario, caplog, plugin, "0s")
    assert warning.startswith("Flies 1: ")


@pytest.mark.parametrize("mode", [gradysim.integrated.run, gradysim.prototype.run])
@pytest.mark.parametrize("plugin", PLUGINS)
def test_nodes_with_telemetry_log_no_warning(mode, make_scenario, caplog, plugin):
    assert warnings_of(mode, make_scenario, caplog, plugin, "10ms") == []
