"""Interfaces with a range instead of a power."""

from inspect import signature

import pytest

from gradysim.cli.calibrate import calibrate_power
from gradysim.integrated.calibration import calibrate
from gradysim.integrated.network import medium_config, node_config
from gradysim.integrated.power_for_range import MESSAGE_BYTES, RATIO, PowersForRanges
from gradysim.integrated.run import run
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.keys import engine_key
from python.integrated.fading_link import link

RANGE = "**.wlan[*].radio.transmitter.communicationRange = 150m"
POWER = "**.wlan[*].radio.transmitter.power = 1mW"
TWO_RAYS = '*.radioMedium.pathLoss.typename = "TwoRayInterference"'


@pytest.mark.parametrize(
    ("settings", "is_for_range"), [((RANGE, POWER), True), ((POWER, RANGE), False), ((RANGE,), True)]
)
def test_of_range_and_power_the_first_line_is_in_force(settings: tuple[str, ...], is_for_range: bool) -> None:
    scenario = link(*settings)
    assert scenario.nodes[0].wlan[0].range_sets_power == is_for_range
    expected_w = calibrate(scenario, 150).tx_power_w if is_for_range else 1e-3
    power = f"**.wlan[*].radio.transmitter.power = {expected_w * 1000!r}mW"
    assert run(scenario).fingerprint == run(link(power)).fingerprint


def powers_w(scenario: Scenario, node: int) -> list[float]:
    """Return the powers of a node's interfaces."""
    config = node_config(scenario.nodes[node])
    PowersForRanges(medium_config(scenario)).set_powers(config, scenario.nodes[node])
    return [interface.radio.tx_power_w for interface in config.wlan]


def test_each_interface_has_the_power_that_itself_needs() -> None:
    two = link(RANGE, "*.sender.numWlanInterfaces = 2", "*.sender.wlan[0].bitrate = 54Mbps")
    first, second = powers_w(two, 0)
    assert [second] == powers_w(link(RANGE), 0)
    assert first != second


def test_the_power_for_a_range_is_that_at_the_nodes_height() -> None:
    heights = "*.receivers[*].mobility.lineStartZ = 5m", "*.receivers[*].mobility.lineStepZ = 5m"
    scenario = link(RANGE, TWO_RAYS, *heights)
    powers = PowersForRanges(medium_config(scenario))
    found_w = []
    for spec in scenario.nodes[1:3]:
        config = node_config(spec)
        powers.set_powers(config, spec)
        found_w.append(config.wlan[0].radio.tx_power_w)
    assert found_w[0] != pytest.approx(found_w[1], rel=0.1)


def test_who_is_exactly_at_the_end_of_the_range_hears_where_the_sensitivity_decides() -> None:
    for step in range(20):
        range_m = 0.9 * 1.75**step
        scenario = link(
            f"**.wlan[*].radio.transmitter.communicationRange = {range_m!r}m",
            "**.radio.receiver.sensitivity = -85dBm",
            "*.receivers.count = 1",
            f"*.receivers[*].mobility.lineStartX = {range_m!r}m",
            "*.receivers[*].mobility.lineStartZ = 30m",
            "*.sender.protocol.stop = 1.001s",
            "sim-time-limit = 1.1s",
        )
        sent, received = (node.tracked_variables for node in run(scenario).nodes)
        assert (sent["sent"], received["received"]) == (1, 1), range_m


def test_what_a_range_means_is_the_same_wherever_it_is_said() -> None:
    defaults = signature(calibrate_power).parameters
    assert (defaults["ratio"].default, defaults["message"].default) == (RATIO, f"{MESSAGE_BYTES}B")
    meaning = engine_key("radio.communication_range_m").meaning
    assert f" {MESSAGE_BYTES} B" in meaning
    assert RATIO == 0.5


def test_a_range_alone_sets_no_power_where_the_range_itself_counts() -> None:
    medium = '*.radioMedium.typename = "UnitDiskRadioMedium"'
    scenario = link(RANGE, medium)
    assert node_config(scenario.nodes[0]).wlan[0].radio.communication_range_m == 150
    sender, nearest = run(scenario).nodes[:2]
    assert nearest.tracked_variables["received"] == sender.tracked_variables["sent"]


def test_a_range_that_no_power_reaches_is_an_error_at_its_line() -> None:
    deaf = '**.antenna.typename = "ConstantGainAntenna"', "**.antenna.gain = -300dB"
    with pytest.raises(ConfigError) as error:
        run(link(RANGE, *deaf))
    assert error.value.key == RANGE.partition(" ")[0]


def test_two_rays_that_cancel_are_why_no_power_reaches_a_range() -> None:
    with pytest.raises(ConfigError, match="; with TwoRayInterference, "):
        run(link(RANGE, TWO_RAYS, "*.sender.mobility.initialZ = 0m"))


def test_a_range_takes_frames_that_are_long_enough_for_what_it_means() -> None:
    with pytest.raises(ConfigError) as error:
        run(link(RANGE, "**.mac.mtu = 77B"))
    assert error.value.key == "**.mac.mtu"
    run(link(RANGE, "**.mac.mtu = 78B", "sim-time-limit = 1ms"))
