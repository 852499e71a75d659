"""Bands and the center frequencies of their channels."""

import pytest

from gradysim.scenario.errors import BadValue
from gradysim.scenario.parse.expressions import parse_value
from gradysim.scenario.schema.parameter_types import (
    CHANNEL_OF_802154,
    CHANNELS,
    channel_by_default,
    first_channel_of_band,
)


@pytest.mark.parametrize(
    ("band", "first_mhz", "last", "last_mhz"),
    [
        ("2.4 GHz", 2412, 13, 2484),
        ("5 GHz", 5002.5, 199, 5997.5),
        ("5 GHz (20 MHz)", 5010, 24, 5490),
        ("5 GHz (40 MHz)", 5020, 11, 5460),
        ("5 GHz (80 MHz)", 5040, 4, 5360),
        ("5 GHz (160 MHz)", 5080, 1, 5240),
        ("5.9 GHz", 5860, 6, 5920),
    ],
)
def test_first_and_last_channel(band: str, first_mhz: float, last: int, last_mhz: float) -> None:
    assert CHANNELS[band].convert(parse_value("0")) == first_mhz * 1e6
    assert CHANNELS[band].convert(parse_value(str(last))) == last_mhz * 1e6
    with pytest.raises(BadValue):
        CHANNELS[band].convert(parse_value(str(last + 1)))


def test_channels_at_2_4_ghz_are_5_mhz_apart() -> None:
    assert CHANNELS["2.4 GHz"].convert(parse_value("5")) == 2.437e9


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("36", "; channel 36 of the 5 GHz band is `radio.centerFrequency = 5180MHz`"),
        ("177", "; channel 177 of the 5 GHz band is `radio.centerFrequency = 5885MHz`"),
        ("35", ""),
        ("178", ""),
        ("36.0", "; did you mean `36`, or `int(...)` of an expression?"),
        ("40s", ""),
    ],
)
def test_a_channel_of_the_5_ghz_band_is_told_by_its_frequency(text: str, hint: str) -> None:
    with pytest.raises(BadValue) as caught:
        CHANNELS["2.4 GHz"].convert(parse_value(text))
    assert caught.value.hint == hint


def test_a_band_alone_is_its_first_channel() -> None:
    assert first_channel_of_band().convert(parse_value('"5 GHz (20 MHz)"')) == 5.01e9


def test_the_nearest_name_is_suggested() -> None:
    with pytest.raises(BadValue) as caught:
        first_channel_of_band().convert(parse_value('"5 GHz (20MHz)"'))
    assert caught.value.suggestion == "5 GHz (20 MHz)"


@pytest.mark.parametrize(("number", "centre_mhz"), [(11, 2405), (12, 2410), (20, 2450), (26, 2480)])
def test_channels_of_802154_have_the_numbers_of_the_standard(number: int, centre_mhz: float) -> None:
    assert CHANNEL_OF_802154.convert(parse_value(str(number))) == centre_mhz * 1e6
    assert CHANNEL_OF_802154.show(centre_mhz * 1e6) == str(number)


@pytest.mark.parametrize("number", [0, 10, 27])
def test_802154_has_no_other_channels_at_2_4_ghz(number: int) -> None:
    with pytest.raises(BadValue):
        CHANNEL_OF_802154.convert(parse_value(str(number)))
    assert CHANNEL_OF_802154.show(2.405e9 + 5e6 * (number - 11)) == "none"


def test_no_centre_is_a_channel_of_both_standards() -> None:
    of_80211 = {CHANNELS["2.4 GHz"].convert(parse_value(str(number))) for number in range(14)}
    assert of_80211.isdisjoint(
        CHANNEL_OF_802154.convert(parse_value(str(number))) for number in range(11, 27)
    )


@pytest.mark.parametrize(("centre_mhz", "shown"), [(2412, "0"), (2450, "20"), (2451, "none")])
def test_a_channel_is_shown_as_its_standard_counts(centre_mhz: float, shown: str) -> None:
    assert channel_by_default().show(centre_mhz * 1e6) == shown
