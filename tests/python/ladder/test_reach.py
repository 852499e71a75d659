"""The circle of the ideal levels has the size of the radio's range."""

from collections.abc import Callable

import pytest

from gradysim.integrated.calibration import calibrate
from gradysim.ladder.campaign import Campaign
from gradysim.scenario.errors import ConfigError

FADING = '*.radioMedium.pathLoss.typename = "RayleighFading"\n'
SHADOWING = "*.radioMedium.shadowing.standardDeviation = 4dB\n"
DIPOLES = '**.antenna.typename = "DipoleAntenna"\n'
NOISE = "*.radioMedium.backgroundNoise.power = -90dBm\n"


def ranges_m(campaign: Campaign, effects: frozenset[str] = frozenset({"range"})) -> list[float]:
    """Return the range of each node with these effects."""
    scenario = campaign.scenario(effects, 0)
    return [float(node.wlan[0].radio["communication_range_m"].value) for node in scenario.nodes]


@pytest.mark.parametrize(
    "file", ["", FADING, SHADOWING, DIPOLES, NOISE, FADING + SHADOWING + DIPOLES + NOISE]
)
@pytest.mark.parametrize("power_mw", [0.32, 20])
def test_half_of_the_frames_arrive_at_the_radius(
    make_campaign: Callable[..., Campaign], file: str, power_mw: float
) -> None:
    """`calibrate` finds the power of the file for that range, without the effects in the file."""
    campaign = make_campaign(f"**.transmitter.power={power_mw}mW", file=file)
    radius_m, *others = ranges_m(campaign)
    assert others == [radius_m, radius_m]
    radio = campaign.scenario(frozenset({"range", "airtime", "access", "interference", "capture"}), 0)
    assert calibrate(radio, radius_m).tx_power_w * 1e3 == pytest.approx(power_mw, rel=1e-6)


def test_it_is_where_free_space_reaches_the_sensitivity(make_campaign: Callable[..., Campaign]) -> None:
    wavelength_m = 299_792_458 / 2.412e9
    expected_m = wavelength_m / (4 * 3.141592653589793) * (0.32e-3 / 10 ** (-85 / 10 - 3)) ** 0.5
    assert ranges_m(make_campaign()) == pytest.approx([expected_m] * 3, rel=1e-6)


def test_nodes_with_other_powers_have_other_ranges(make_campaign: Callable[..., Campaign]) -> None:
    near, far, again = ranges_m(make_campaign("*.nodes[1].wlan[*].radio.transmitter.power=1.28mW"))
    assert near == again
    assert far == pytest.approx(2 * near)


def test_a_range_in_the_file_is_one_power_at_all_levels(make_campaign: Callable[..., Campaign]) -> None:
    """The power is that for the range with fading, also where fading is left out."""
    line = "**.transmitter.communicationRange=100m"
    campaign = make_campaign(line, file=FADING)
    expected_w = calibrate(campaign.scenario(campaign.all_effects, 0), 100).tx_power_w
    for level in range(4, len(campaign.levels)):
        for node in campaign.scenario(campaign.effects_up_to(level), 0).nodes:
            assert node.wlan[0].radio["tx_power_w"].value == pytest.approx(expected_w, rel=1e-6)


def test_the_range_of_a_unit_disk_stays_as_it_is(make_campaign: Callable[..., Campaign]) -> None:
    disk = '*.radioMedium.typename = "UnitDiskRadioMedium"\n**.transmitter.communicationRange = 100m\n'
    campaign = make_campaign(file=disk)
    assert ranges_m(campaign) == [100] * 3
    assert ranges_m(campaign, frozenset()) == [1e9] * 3


def test_a_value_that_the_engine_rejects_has_its_line(make_campaign: Callable[..., Campaign]) -> None:
    campaign = make_campaign('**.wlan[*].opMode="b"', file="**.wlan[*].bitrate = 54Mbps\n")
    with pytest.raises(ConfigError, match=r"test\.ini:\d+: .* b, .* 1, 2, 5\.5, 11 Mbps"):
        campaign.scenario(campaign.all_effects, 0)
