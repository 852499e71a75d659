"""Nodes with several network interfaces in .ini files."""

from typing import Any

import pytest

from gradysim.scenario.schema.parameter_types import CHANNELS

TWO = "*.uavs[*].numWlanInterfaces = 2\n"


def carriers(node: Any) -> list[float | None]:
    return [wlan.radio["carrier_hz"].value if wlan.radio else None for wlan in node.wlan]


def test_a_node_has_one_interface_unless_something_else_is_said(folder: Any) -> None:
    assert [len(node.wlan) for node in folder.load().nodes] == [1, 1, 1]


def test_each_node_has_as_many_interfaces_as_the_first_entry_says(folder: Any) -> None:
    scenario = folder.load("*.uavs[1].numWlanInterfaces = 3\n**.numWlanInterfaces = 2\n")
    assert {node.name: len(node.wlan) for node in scenario.nodes} == {
        "groundStation": 2,
        "uavs[0]": 2,
        "uavs[1]": 3,
    }


def test_keys_reach_the_interface_they_name(folder: Any) -> None:
    scenario = folder.load(TWO + "*.uavs[*].wlan[1].radio.channelNumber = 5\n")
    assert [carriers(node) for node in scenario.nodes if node.group == "uavs"] == [[None, 2.437e9]] * 2


def test_a_star_stands_for_all_interfaces(folder: Any) -> None:
    scenario = folder.load(TWO + "*.uavs[*].wlan[*].radio.transmitter.power = 1mW\n")
    for node in scenario.nodes:
        if node.group == "uavs":
            assert [wlan.radio["tx_power_w"].value for wlan in node.wlan] == [0.001, 0.001]
            assert node.wlan[0] is node.wlan[1]


def test_a_range_of_indices_stands_for_those_interfaces(folder: Any) -> None:
    scenario = folder.load('**.numWlanInterfaces = 3\n**.wlan[1..2].opMode = "a"\n')
    modes = [
        [wlan.mac["op_mode"].value if wlan.mac else None for wlan in node.wlan] for node in scenario.nodes
    ]
    assert modes == [[None, "a", "a"]] * 3


def test_a_range_may_go_beyond_the_interfaces_of_a_node(folder: Any) -> None:
    """As in all patterns of OMNeT++: nodes of one file have different numbers of interfaces."""
    scenario = folder.load(TWO + '**.wlan[1..5].opMode = "a"\n')
    assert [wlan.mac.keys() for wlan in scenario.nodes[1].wlan] == [set(), {"op_mode"}]


def test_interfaces_of_both_kinds(folder: Any) -> None:
    scenario = folder.load(TWO + '*.uavs[*].wlan[1].typename = "Ieee802154NarrowbandInterface"\n')
    typenames = [wlan.interface.get("typename") for wlan in scenario.nodes[1].wlan]
    assert [setting and setting.value for setting in typenames] == [None, "Ieee802154NarrowbandInterface"]


SENSORS = '*.uavs[*].wlan[*].typename = "Ieee802154NarrowbandInterface"\n'


def test_an_802154_interface_counts_channels_as_its_standard(folder: Any) -> None:
    scenario = folder.load(SENSORS + "*.uavs[*].wlan[*].radio.channelNumber = 12\n")
    assert [carriers(node) for node in scenario.nodes] == [[None], [2.41e9], [2.41e9]]


def test_each_interface_of_a_node_counts_for_itself(folder: Any) -> None:
    second = SENSORS.replace("wlan[*]", "wlan[1]")
    scenario = folder.load(TWO + second + "*.uavs[*].wlan[*].radio.channelNumber = 11\n")
    assert carriers(scenario.nodes[1]) == [2.467e9, 2.405e9]


@pytest.mark.parametrize("number", [0, 10, 27])
def test_a_channel_that_802154_has_not_is_refused(folder: Any, number: int) -> None:
    error = folder.mistake(SENSORS + f"*.uavs[*].wlan[*].radio.channelNumber = {number}\n")
    assert (error.line, error.value) == (7, str(number))
    assert "802.15.4, 11 to 26" in error.expected


@pytest.mark.parametrize(
    ("number", "told", "before", "expected"),
    [
        (
            5,
            "11 to 26 (2.405 GHz to 2.48 GHz), since wlan[0] of uavs[0] is of 802.15.4",
            "*.uavs[*].wlan[0].radio.channelNumber = default\n",
            [[2.437e9], [None], [None]],
        ),
        (
            20,
            "0 (2.412 GHz) to 13, since wlan[0] of groundStation is of 802.11",
            "*.groundStation.wlan[0].radio.channelNumber = default\n",
            [[None], [2.45e9], [2.45e9]],
        ),
    ],
)
def test_a_number_that_only_one_standard_has_can_be_kept_from_the_other(
    folder: Any, number: int, told: str, before: str, expected: list[list[float | None]]
) -> None:
    line = f"**.channelNumber = {number}\n"
    error = folder.mistake(SENSORS + line)
    assert told in error.message
    assert f"`{before.strip()}`" in error.hint
    assert [carriers(node) for node in folder.load(SENSORS + before + line).nodes] == expected


def test_a_wrong_channel_where_all_interfaces_are_alike_says_nothing_of_others(folder: Any) -> None:
    assert folder.error("**.channelNumber = 20\n").endswith("0 (2.412 GHz) to 13")


def test_an_802154_interface_reads_no_name_of_a_band(folder: Any) -> None:
    """A line with wildcards is meant for the other interfaces."""
    scenario = folder.load(SENSORS + '**.bandName = "5.9 GHz"\n')
    assert [carriers(node) for node in scenario.nodes] == [[5.86e9], [None], [None]]
    assert carriers(
        folder.load(SENSORS + '**.bandName = "5 GHz"\n*.uavs[*].**.channelNumber = 26\n').nodes[1]
    ) == [2.48e9]


@pytest.mark.parametrize("frequency_first", [True, False])
def test_of_frequency_and_channel_the_first_counts_for_802154_too(folder: Any, frequency_first: bool) -> None:
    lines = ["*.uavs[*].**.centerFrequency = 2.46GHz\n", "*.uavs[*].**.channelNumber = 11\n"]
    scenario = folder.load(SENSORS + "".join(lines if frequency_first else lines[::-1]))
    assert carriers(scenario.nodes[1]) == [2.46e9 if frequency_first else 2.405e9]


@pytest.mark.parametrize(
    ("added", "message"),
    [
        (
            "*.uavs[*].wlan[1].radio.bandwidth = 20MHz\n",
            "`*.uavs[*].wlan[1].radio.bandwidth` matches no parameter; expected one of an interface that "
            "`numWlanInterfaces` of the node counts",
        ),
        (
            "**.wlan[2..3].radio.bandwidth = 20MHz\n",
            "`**.wlan[2..3].radio.bandwidth` matches no parameter; expected one of an interface that "
            "`numWlanInterfaces` of the node counts",
        ),
        (
            "*.uavs[*].wlan[1].radio.bandwith = 20MHz\n" + TWO,
            "`*.uavs[*].wlan[1].radio.bandwith` matches no parameter; expected the name of one; "
            "did you mean `*.uavs[*].wlan[1].radio.bandwidth`?",
        ),
        (
            "*.uavs[*].numWlanInterfaces = 0\n",
            "= 0: it is out of range; expected an integer, at least 1 and at most 16",
        ),
    ],
)
def test_errors(folder: Any, added: str, message: str) -> None:
    assert folder.error(added).startswith("test.ini:6: ")
    assert message in folder.error(added)


def test_a_key_of_an_interface_that_is_not_there_is_not_its_own_suggestion(folder: Any) -> None:
    assert folder.mistake("*.uavs[*].wlan[1].radio.bandwidth = 20MHz\n").suggestion == ""


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        (
            "*.groundStation.wlan[0].radio.channelNumber = 20",
            "channel of the 2.4",
        ),
        (
            "*.uavs[*].wlan[*].radio.channelNumber = 5",
            "channel of IEEE 802.15.4",
        ),
    ],
)
def test_a_number_for_one_standard_alone_has_no_other_to_be_left_to(
    folder: Any, line: str, problem: str
) -> None:
    error = folder.error(f"{SENSORS}{line}\n")
    assert problem in error
    assert "leaves" not in error


def test_each_interface_draws_its_own_values(folder: Any) -> None:
    scenario = folder.load(TWO + "*.uavs[*].wlan[*].radio.transmitter.power = uniform(1mW, 9mW)\n")
    powers = [wlan.radio["tx_power_w"].value for node in scenario.nodes[1:] for wlan in node.wlan]
    assert len(set(powers)) == 4
    assert all(0.001 <= power < 0.009 for power in powers)


def test_of_two_keys_for_one_field_the_first_in_search_order_counts(folder: Any) -> None:
    added = "**.channelNumber = 5\n[X]\n**.centerFrequency = 2.5GHz\n"
    assert folder.load(added).nodes[0].wlan[0].radio["carrier_hz"].value == 2.437e9
    assert folder.load(added, "X").nodes[0].wlan[0].radio["carrier_hz"].value == 2.5e9


@pytest.mark.parametrize("order", [1, -1])
def test_a_channel_is_one_of_its_band_in_any_order(folder: Any, order: int) -> None:
    lines = ['**.bandName = "5 GHz (20 MHz)"\n', "**.channelNumber = 8\n"]
    scenario = folder.load("".join(lines[::order]))
    assert scenario.nodes[0].wlan[0].radio["carrier_hz"].value == 5.17e9


@pytest.mark.parametrize("order", [1, -1])
def test_a_band_says_nothing_where_the_centre_is_given(folder: Any, order: int) -> None:
    lines = ['**.bandName = "5 GHz"\n', "**.centerFrequency = 5180MHz\n"]
    assert folder.load("".join(lines[::order])).nodes[0].wlan[0].radio["carrier_hz"].value == 5.18e9


def test_the_frequency_counts_when_it_comes_before_the_channel(folder: Any) -> None:
    band = '**.bandName = "5.9 GHz"\n'
    frequency, channel = "**.centerFrequency = 5.18GHz\n", "**.channelNumber = 3\n"
    first, last = folder.load(band + frequency + channel), folder.load(band + channel + frequency)
    assert first.nodes[0].wlan[0].radio["carrier_hz"].value == 5.18e9
    assert last.nodes[0].wlan[0].radio["carrier_hz"].value == 5.89e9


def test_a_channel_that_its_band_has_not_is_an_error(folder: Any) -> None:
    error = folder.mistake('**.bandName = "5.9 GHz"\n**.channelNumber = 13\n')
    assert (error.line, error.expected) == (7, CHANNELS["5.9 GHz"].expected)
