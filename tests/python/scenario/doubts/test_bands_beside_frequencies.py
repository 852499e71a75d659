from typing import Any

import pytest

from gradysim.scenario.doubts.bands_beside_frequencies import bands_beside_frequencies

BAND = '**.radio.bandName = "5 GHz"\n'
CENTRE = "**.radio.centerFrequency = 2.412GHz\n"
CHANNEL = "**.radio.channelNumber = 3\n"


def told(folder: Any, added: str, config: str = "General", *overrides: str) -> list[str]:
    return list(bands_beside_frequencies(folder.load(added, config, *overrides).nodes))


@pytest.mark.parametrize(("lines", "band", "centre"), [(BAND + CENTRE, 6, 7), (CENTRE + BAND, 7, 6)])
def test_a_band_beside_a_frequency_is_told_whichever_comes_first(
    folder: Any, lines: str, band: int, centre: int
) -> None:
    assert told(folder, lines) == [
        f"{folder.ini}:{band}: warning: `**.radio.bandName` has no effect: line {centre},"
        " `**.radio.centerFrequency`, says which channel it is; expected one of them, or a channelNumber in"
        " that band"
    ]


def test_a_channel_that_comes_after_the_frequency_counts_in_no_band(folder: Any) -> None:
    assert len(told(folder, CENTRE + CHANNEL + BAND)) == 1


@pytest.mark.parametrize(
    "lines",
    [
        BAND,
        CENTRE,
        BAND + CHANNEL,
        BAND + CHANNEL + CENTRE,
        CHANNEL + CENTRE + BAND,
        BAND + CENTRE.replace("2.412GHz", "default"),
        BAND.replace('"5 GHz"', "default") + CENTRE,
        "*.uavs[0].wlan[0]" + CENTRE.removeprefix("**") + BAND,
        "*.uavs[0].wlan[0]" + CHANNEL.removeprefix("**") + CENTRE + BAND,
    ],
)
def test_a_band_that_some_interface_reads_is_not_told(folder: Any, lines: str) -> None:
    assert told(folder, lines) == []


def test_a_section_may_override_the_band_by_a_frequency_but_not_the_other_way_round(folder: Any) -> None:
    assert told(folder, f"{BAND}[Config A]\n{CENTRE}", "A") == []
    assert len(told(folder, f"{CENTRE}[Config A]\n{BAND}", "A")) == 1


def test_a_file_that_is_included_and_a_command_line_may_be_overridden(folder: Any) -> None:
    folder.write("base.ini", BAND)
    assert told(folder, f"{CENTRE}include base.ini\n") == []
    assert told(folder, BAND, "General", CENTRE) == []


def test_the_place_of_an_override_is_its_own(folder: Any) -> None:
    (text,) = told(folder, CENTRE, "General", BAND)
    assert text.startswith('override **.radio.bandName="5 GHz": warning: ')
    assert f" no effect: {folder.ini}:6, `**.radio.centerFrequency`, says" in text
