from pathlib import Path

import pytest

from gradysim.integrated.engine_errors import EngineError, errors_at
from gradysim.integrated.network import check_scenario
from gradysim.scenario import load_scenarios
from gradysim.scenario.errors.config_error import ConfigError
from gradysim.scenario.errors.source import Source
from gradysim.scenario.settings import Setting

WLAN = "*.uavs[*].wlan[*]"
ANTENNA = f"{WLAN}.radio.antenna"
RECEIVER = f"{WLAN}.radio.receiver"
NOISE = "*.radioMedium.backgroundNoise"
DETECTION = "wlan[*].radio.receiver.energyDetection"
MINI = """[General]
sim-time-limit = 1s
*.uavs.count = 2
*.uavs[*].protocol.class = "protocol.py:Tested"
"""


def setting(value, key="key"):
    return Setting(value, Source(Path("a.ini"), 7, key, str(value)))


def error_of(text, settings):
    with pytest.raises(ConfigError) as error, errors_at(settings):
        raise ValueError(text)
    return str(error.value)


def test_an_error_that_names_no_setting_is_one_without_a_place():
    assert error_of("nothing works", {"radio.tx_power_w": setting(0)}) == "nothing works"


def test_an_error_that_knows_its_place_is_left_alone():
    known = ConfigError("mac.cw_min = 7: wrong", Source(Path("a.ini"), 3))
    with pytest.raises(ConfigError) as error, errors_at({"mac.cw_min": setting(7, "cwMin")}):
        raise known
    assert error.value is known


def test_the_field_that_is_named_first_is_the_wrong_one():
    settings = {"mac.cw_max": setting(3, "cwMax"), "mac.cw_min": setting(7, "cwMin")}
    told = error_of("mac.cw_min = 7: expected at most mac.cw_max", settings)
    assert told == "a.ini:7: cwMin = 7: expected at most wlan[*].mac.dcf.channelAccess.cwMax"


@pytest.mark.parametrize(
    ("text", "target"),
    [
        ("wlan[1].mac.cw_min = 7: expected at most mac.cw_max", "mac.cw_min"),
        ("radio.carrier_hz: a hears no b", "radio.carrier_hz"),
        ("nothing works", ""),
    ],
)
def test_the_field_that_it_is_about_is_a_value_of_the_error(text, target):
    with pytest.raises(EngineError) as error, errors_at({"mac.cw_min": setting(7, "cwMin")}):
        raise ValueError(text)
    assert error.value.target == target


def test_a_part_of_a_name_is_no_name():
    told = error_of("radio.tx_power_w = 1 W: wrong", {"radio.power_w": setting(0)})
    assert told == "wlan[*].radio.transmitter.power = 1000mW (its default): wrong"


def test_where_nothing_else_was_set_the_number_of_interfaces_is_the_cause():
    told = error_of(
        "radio.tx_power_w = 1 W: wrong", {"node.num_wlan_interfaces": setting(2, "numWlanInterfaces")}
    )
    assert told == (
        "a.ini:7: numWlanInterfaces = 2: wlan[*].radio.transmitter.power = 1000mW (its default): wrong"
    )


def test_two_interfaces_on_one_channel_by_default_are_too_many_not_of_the_wrong_kind():
    settings = {
        "interface.typename": setting("Ieee802154NarrowbandInterface", "typename"),
        "node.num_wlan_interfaces": setting(2, "numWlanInterfaces"),
    }
    told = error_of("radio.carrier_hz = 2450000000 Hz: expected another channel", settings)
    assert told.startswith("a.ini:7: numWlanInterfaces = 2: ")


def test_what_was_calculated_is_told():
    settings = {"mac.mtu_bytes": Setting(10, Source(Path("a.ini"), 7, "mtu", "2 * 5B"))}
    told = error_of("mac.mtu_bytes = 10 B: expected at least 29 B", settings)
    assert told == "a.ini:7: mtu = 2 * 5B: that is 10B: expected at least 29B"


@pytest.mark.parametrize(
    ("lines", "told"),
    [
        (
            [f"{NOISE}.power = -80dBm"],
            f"5: {NOISE}.power = -80dBm: {DETECTION} = -85dBm (its default): expected more than the"
            " background noise of -80dBm, which would keep the channel busy for ever",
        ),
        (
            [f'{NOISE}.typename = "ThermalNoise"', f"{NOISE}.temperature = 40000K"],
            f"6: {NOISE}.temperature = 40000K: {DETECTION} = -85dBm (its default): expected more than the"
            " background noise of",
        ),
        (
            [f"{NOISE}.power = 1nW", f'{NOISE}.typename = "ThermalNoise"', f"{RECEIVER}.noiseFigure = 60dB"],
            f"7: {RECEIVER}.noiseFigure = 60dB: {DETECTION} = -85dBm (its default): expected",
        ),
        (
            [f'{ANTENNA}.typename = "CosineAntenna"'],
            f'5: {ANTENNA}.typename = "CosineAntenna": wlan[*].radio.antenna.beamWidth has to be given:'
            " expected more than 0deg",
        ),
        (
            ['**.antenna.typename = "ParabolicAntenna"'],
            '5: **.antenna.typename = "ParabolicAntenna": wlan[*].radio.antenna.beamWidth has to be given:'
            " expected more than 0deg",
        ),
        (
            [f'{ANTENNA}.typename = "ParabolicAntenna"', f"{ANTENNA}.beamWidth = 7rad"],
            f"6: {ANTENNA}.beamWidth = 7rad: expected from 0deg to 359.82deg",
        ),
        (
            [
                f'{ANTENNA}.typename = "ParabolicAntenna"',
                f"{ANTENNA}.beamWidth = 1rad",
                f"{ANTENNA}.maxGain = -30dB",
            ],
            f"7: {ANTENNA}.maxGain = -30dB: wlan[*].radio.antenna.minGain = -20dB (its default): expected at"
            " most wlan[*].radio.antenna.maxGain, -30dB",
        ),
        (
            [f'{RECEIVER}.errorModel.typename = "Ieee80211BerTableErrorModel"'],
            f'5: {RECEIVER}.errorModel.typename = "Ieee80211BerTableErrorModel":'
            " wlan[*].radio.receiver.errorModel.berTableFile has to be given: expected a file that can be"
            " read",
        ),
        (
            [f"{WLAN}.mac.mtu = 40B", f"{WLAN}.radio.transmitter.communicationRange = 50m"],
            f"5: {WLAN}.mac.mtu = 40B: expected at least 78B: transmitter.communicationRange is about"
            " messages of 50B, which have 28B of headers",
        ),
        (
            [
                f'{RECEIVER}.frameCapture.typename = "SimpleFrameCapture"',
                f"{RECEIVER}.frameCapture.margin = -3dB",
            ],
            f"6: {RECEIVER}.frameCapture.margin = -3dB: expected at least 0dB",
        ),
        (
            ["*.uavs[*].numWlanInterfaces = 2"],
            "5: *.uavs[*].numWlanInterfaces = 2: wlan[1].radio.centerFrequency = 2412MHz (its default):"
            " expected another channel than that of wlan[0] of uavs[0]",
        ),
        (
            [f"{WLAN}.bitrate = 7Mbps"],
            f"5: {WLAN}.bitrate = 7Mbps: expected a bitrate of g(mixed), which has",
        ),
        (
            [f"{WLAN}.radio.transmitter.power = 1e300W"],
            f"5: {WLAN}.radio.transmitter.power = 1e300W: expected from 0mW to 1000GW",
        ),
        (
            ["**.transmitter.power = 1e300W"],
            "5: **.transmitter.power = 1e300W: for wlan[*].radio.transmitter.power: expected from 0mW to",
        ),
        (
            ["**.cwMin = 20000 * 2"],
            "5: **.cwMin = 20000 * 2: for wlan[*].mac.dcf.channelAccess.cwMin: that is 40000: expected",
        ),
        (["**.wlan[*].bitrate = 7Mbps"], "5: **.wlan[*].bitrate = 7Mbps: expected a bitrate of g(mixed)"),
        (
            [f"{WLAN}.radio.centerFrequency = 1Hz"],
            f"5: {WLAN}.radio.centerFrequency = 1Hz: expected from 1MHz to 1000GHz",
        ),
        (
            [
                '*.uavs[*].protocol.typename = "BeaconProtocol"',
                "*.uavs[*].protocol.payload_bytes = 3000",
            ],
            "6: *.uavs[*].protocol.payload_bytes = 3000: expected from 0B to 2276B, the longest message",
        ),
        (
            ['*.uavs[*].protocol.typename = "SaturatingSource"'],
            '5: *.uavs[*].protocol.typename = "SaturatingSource": protocol.destination = 0 (its default):'
            " expected the id of another node than uavs[0] itself, from 0 to 1",
        ),
    ],
)
def test_a_mistake_is_told_in_the_terms_of_the_file_at_its_nearest_cause(
    make_scenario, tmp_path, lines, told
):
    make_scenario("class Tested(Quiet): pass")
    path = tmp_path / "test.ini"
    is_native = any("protocol.typename" in line for line in lines)
    start = MINI.replace("*.uavs[*].protocol.class", "#") if is_native else MINI
    path.write_text(start + "\n".join(lines) + "\n")
    (scenario,) = load_scenarios(path)
    with pytest.raises(ConfigError) as error:
        check_scenario(scenario)
    assert str(error.value).startswith(f"{path}:{told}")
