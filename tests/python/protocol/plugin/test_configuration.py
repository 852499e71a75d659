import re

import pytest

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
    with pytest.raises(TypeError, match=r"expected a protocol .*, got 'run'"):
        create_statistics("run")
