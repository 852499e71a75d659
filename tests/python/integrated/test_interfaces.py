"""Nodes with several network interfaces: places of errors, and the interface of each message."""

from contextlib import nullcontext

import pytest

from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.network import check_scenario
from gradysim.integrated.run import run
from gradysim.protocol.defaults import MOST_INTERFACES
from gradysim.protocol.errors import CommunicationException
from gradysim.scenario.errors import ConfigError

QUIET = "class Tested(Quiet): pass"
TWO = "*.uavs[*].numWlanInterfaces = 2"
CHANNEL = "*.uavs[*].wlan[1].radio.channelNumber = 5"
UNIT_DISK = '*.radioMedium.typename = "UnitDiskRadioMedium"'
SENDING = """class Tested(Quiet):
    def initialize(self):
        self.provider.send_communication_command(BroadcastMessageCommand("text", interface={}))"""


def key_of(line: str) -> str:
    return line.partition(" ")[0]


@pytest.mark.parametrize(
    ("lines", "wrong", "text"),
    [
        ([CHANNEL], "*.uavs[*].wlan[1].bitrate = 7Mbps", " g(mixed)"),
        (
            [CHANNEL],
            "*.uavs[*].wlan[1].radio.receiver.energyDetection = -120dBm",
            " -110dBm",
        ),
        ([CHANNEL], "*.uavs[*].wlan[1].radio.transmitter.communicationRange = 1e30m", "power"),
        ([], "*.uavs[*].wlan[*].radio.channelNumber = 5", "wlan[0] of uavs[0]"),
    ],
)
def test_a_mistake_is_told_at_the_line_of_that_interface(make_scenario, lines, wrong, text):
    with pytest.raises(ConfigError) as error:
        check_scenario(make_scenario(QUIET, TWO, *lines, wrong))
    assert error.value.key == key_of(wrong)
    assert text in str(error.value)


def test_interfaces_that_share_a_channel_by_default_are_told_where_they_are_counted(make_scenario):
    with pytest.raises(ConfigError) as error:
        check_scenario(make_scenario(QUIET, TWO))
    assert error.value.key == key_of(TWO)
    assert "wlan[1].radio.centerFrequency = 2412MHz (its default): " in error.value.problem


def test_where_there_are_no_radios_they_need_no_channels(make_scenario):
    assert (
        run(make_scenario(SENDING.format(1), TWO, UNIT_DISK)).outcomes["messages"]["broadcast"]["sent"] == 2
    )


@pytest.mark.parametrize(
    ("interface", "text"),
    [
        ("2", r"^node 0 .* wlan\[2\]: .* 2, .* wlan\[0\]"),
        ("15", r"^node 0 .* wlan\[15\]: .* 2, .* wlan\[0\]"),
    ],
)
def test_a_command_names_an_interface_that_is_there(make_scenario, interface, text):
    with pytest.raises(CommunicationException, match=text):
        run(make_scenario(SENDING.format(interface), TWO, CHANNEL))


def test_an_index_of_a_class_of_its_own_is_an_int_too(make_scenario):
    """For example, members of an enumeration that names the interfaces."""
    sending = SENDING.format("type('Index', (int,), {})(1)")
    assert run(make_scenario(sending, TWO, UNIT_DISK)).outcomes["messages"]["broadcast"]["sent"] == 2


@pytest.mark.parametrize(("count", "is_allowed"), [(MOST_INTERFACES, True), (MOST_INTERFACES + 1, False)])
def test_the_engine_has_as_many_interfaces_as_commands_may_name(count, is_allowed):
    config = load_netsim().NodeConfig("uav", ["Ieee80211Interface"] * count)
    for index, interface in enumerate(config.wlan):
        interface.radio.carrier_hz = 2.4e9 + 5e6 * index
    with nullcontext() if is_allowed else pytest.raises(ValueError, match=str(MOST_INTERFACES)):
        config.validate()
