"""A transmit power for some bitrates: runs, ranges and calibration use that of the bitrate."""

import pytest

from gradysim.integrated.calibration import calibrate
from gradysim.integrated.ranges import ranges_m
from gradysim.integrated.run import run
from gradysim.scenario.errors import ConfigError
from python.integrated.fading_link import link

KEY = "**.wlan[*].radio.transmitter.powerByBitrate"
POWER = "**.wlan[*].radio.transmitter.power = 1mW"
BITRATE = "**.wlan[*].bitrate = 54Mbps"
OTHER = f"{KEY} = [[48Mbps, 20dBm], [6Mbps, 2mW]]"
OWN = f"{KEY} = [[48Mbps, 20dBm], [54Mbps, 2mW]]"
TWICE = "**.wlan[*].radio.transmitter.power = 2mW"
RANGE = "**.wlan[*].radio.transmitter.communicationRange = 150m"


def test_a_run_has_the_power_of_its_bitrate() -> None:
    twice = run(link(BITRATE, TWICE)).fingerprint
    assert run(link(BITRATE, POWER, OWN)).fingerprint == twice
    assert run(link(BITRATE, POWER, OTHER)).fingerprint != twice
    assert run(link(BITRATE, POWER, OTHER)).fingerprint == run(link(BITRATE, POWER)).fingerprint


def test_ranges_are_those_of_the_bitrate() -> None:
    assert ranges_m(link(BITRATE, POWER, OWN)) == ranges_m(link(BITRATE, TWICE))
    assert ranges_m(link(BITRATE, POWER, OTHER)) == ranges_m(link(BITRATE, POWER))


def test_a_calibration_says_which_key_counts() -> None:
    of_bitrate, usual = calibrate(link(BITRATE, OWN), 150), calibrate(link(BITRATE, OTHER), 150)
    assert of_bitrate.is_of_bitrate
    assert not usual.is_of_bitrate
    assert of_bitrate.tx_power_w == usual.tx_power_w


def test_a_range_does_not_set_the_power_of_a_bitrate_that_has_one() -> None:
    with pytest.raises(ConfigError) as error:
        run(link(BITRATE, RANGE, OWN))
    assert error.value.key == "**.wlan[*].radio.transmitter.communicationRange"
    assert run(link(BITRATE, RANGE, OTHER)).fingerprint == run(link(BITRATE, RANGE)).fingerprint


@pytest.mark.parametrize(
    "value",
    [
        "[[7Mbps, 20dBm]]",
        "[[54Mbps, 1mW], [54Mbps, 2mW]]",
        "[54Mbps, 20dBm]",
        "[[54Mbps]]",
        "[[54Mbps, 20dB]]",
        "[[54Mbps, [20dBm]]]",
        "20dBm",
    ],
)
def test_a_wrong_list_is_refused_at_its_line(value: str) -> None:
    with pytest.raises(ConfigError) as error:
        run(link(f"{KEY} = {value}"))
    assert error.value.key == KEY


def test_a_list_that_is_not_a_pair_is_shown_as_written() -> None:
    with pytest.raises(ConfigError) as error:
        run(link(f"{KEY} = [[54Mbps, 20dBm, 1]]"))
    assert error.value.problem is not None
    assert "`[54Mbps, 20dBm, 1]`" in error.value.problem
