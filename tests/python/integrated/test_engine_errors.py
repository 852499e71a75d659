from pathlib import Path

import pytest

from gradysim import _netsim
from gradysim.integrated.engine_errors import EngineError, errors_at
from gradysim.integrated.network import check_scenario
from gradysim.scenario import load_scenarios
from gradysim.scenario.errors import ConfigError, Source
from gradysim.scenario.schema.values import Setting

WLAN = "*.uavs[*].wlan[*]"
ANTENNA = f"{WLAN}.radio.antenna"
RECEIVER = f"{WLAN}.radio.receiver"
NOISE = "*.radioMedium.backgroundNoise"
MINI = """[General]
sim-time-limit = 1s
*.uavs.count = 2
*.uavs[*].protocol.class = "protocol.py:Tested"
"""


def setting(value, key="key"):
    return Setting(value, Source(Path("a.ini"), 7, key, str(value)))


def radio_error(settings, **fields):
    """Return the error of a radio with these fields; `settings` are their places in the file."""
    radio = _netsim.RadioConfig()
    for name, value in fields.items():
        setattr(radio, name, value)
    with pytest.raises(EngineError) as error, errors_at(settings):
        radio.validate()
    return error.value


def test_an_error_without_a_setting_has_no_place():
    error = radio_error({}, tx_power_w=-1)
    assert (error.file, error.target) == (None, "radio.tx_power_w")
    assert "radio.transmitter.power = -1000mW" in error.message


def test_an_error_that_knows_its_place_is_left_alone():
    known = ConfigError("mac.cw_min = 7: wrong", Source(Path("a.ini"), 3))
    with pytest.raises(ConfigError) as error, errors_at({"mac.cw_min": setting(7, "cwMin")}):
        raise known
    assert error.value is known


def test_the_place_is_that_of_the_field_itself_if_it_was_set():
    settings = {"radio.carrier_hz": setting(1e6, "centre"), "radio.bandwidth_hz": setting(22e6, "width")}
    error = radio_error(settings, carrier_hz=1e6)
    assert (error.key, error.line, error.target) == ("width", 7, "radio.bandwidth_hz")


def test_the_place_of_a_default_is_that_of_the_field_it_was_compared_with():
    error = radio_error({"radio.carrier_hz": setting(1e6, "centre")}, carrier_hz=1e6)
    assert (error.key, error.target) == ("centre", "radio.bandwidth_hz")
    assert "radio.bandwidth = 22MHz (its default)" in error.message


def test_where_nothing_else_was_set_the_number_of_interfaces_is_the_cause():
    error = radio_error({"node.num_wlan_interfaces": setting(2, "numWlanInterfaces")}, carrier_hz=1e6)
    assert error.key == "numWlanInterfaces"


def test_a_calculated_value_is_shown():
    settings = {"radio.bandwidth_hz": Setting(22e6, Source(Path("a.ini"), 7, "width", "2 * 11MHz"))}
    assert " 22MHz: " in radio_error(settings, carrier_hz=1e6).message


PARABOLIC = (f'{ANTENNA}.typename = "ParabolicAntenna"', f"{ANTENNA}.beamWidth = 1rad")


@pytest.mark.parametrize(
    ("lines", "line", "target"),
    [
        ([f"{NOISE}.power = -80dBm"], 5, "radio.energy_detection_w"),
        (
            [f'{NOISE}.typename = "ThermalNoise"', f"{NOISE}.temperature = 40000K"],
            6,
            "radio.energy_detection_w",
        ),
        (
            [f"{NOISE}.power = 1nW", f'{NOISE}.typename = "ThermalNoise"', f"{RECEIVER}.noiseFigure = 60dB"],
            7,
            "radio.energy_detection_w",
        ),
        ([f'{ANTENNA}.typename = "CosineAntenna"'], 5, "antenna.beam_width_rad"),
        (['**.antenna.typename = "ParabolicAntenna"'], 5, "antenna.beam_width_rad"),
        ([*PARABOLIC, f"{ANTENNA}.maxGain = -30dB"], 7, "antenna.min_gain"),
        (
            [f'{RECEIVER}.errorModel.typename = "Ieee80211BerTableErrorModel"'],
            5,
            "radio.ber_table_file",
        ),
        (['**.opMode = "g(erp)"', f"{WLAN}.radio.bandwidth = 5MHz"], 6, "radio.bandwidth_hz"),
        (["*.uavs[*].numWlanInterfaces = 2"], 5, "radio.carrier_hz"),
        ([f"{WLAN}.bitrate = 7Mbps"], 5, "mac.bitrate_bps"),
        (["**.wlan[*].bitrate = 7Mbps"], 5, "mac.bitrate_bps"),
        (["**.cwMin = 1000 * 2"], 5, "mac.cw_min"),
        (
            ['*.uavs[*].protocol.typename = "BeaconProtocol"', "*.uavs[*].protocol.payload_bytes = 3000"],
            6,
            "protocol.payload_bytes",
        ),
        (['*.uavs[*].protocol.typename = "SaturatingSource"'], 5, "protocol.destination"),
    ],
)
def test_the_place_of_a_mistake_is_the_line_that_causes_it(make_scenario, tmp_path, lines, line, target):
    make_scenario("class Tested(Quiet): pass")
    path = tmp_path / "test.ini"
    is_native = any("protocol.typename" in line for line in lines)
    start = MINI.replace("*.uavs[*].protocol.class", "#") if is_native else MINI
    path.write_text(start + "\n".join(lines) + "\n")
    (scenario,) = load_scenarios(path)
    with pytest.raises(EngineError) as error:
        check_scenario(scenario)
    assert (error.value.file, error.value.line, error.value.target) == (path, line, target)


def test_a_range_needs_a_message_that_fits_into_a_packet(make_scenario):
    lines = (f"{WLAN}.mac.mtu = 40B", f"{WLAN}.radio.transmitter.communicationRange = 50m")
    scenario = make_scenario("class Tested(Quiet): pass", *lines)
    with pytest.raises(ConfigError) as error:
        check_scenario(scenario)
    assert error.value.key == f"{WLAN}.mac.mtu"
