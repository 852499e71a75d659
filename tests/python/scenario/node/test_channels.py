"""The centre frequency of a radio: by its channel, its band, or itself."""

from typing import Any

import pytest

from gradysim.scenario.errors import ConfigError


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
    with pytest.raises(ConfigError, match=r'expected a channel of the band "5\.9 GHz", 0 \(5860 MHz\) to 6'):
        folder.load('**.bandName = "5.9 GHz"\n**.channelNumber = 13\n')
