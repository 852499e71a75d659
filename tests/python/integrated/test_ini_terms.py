import pytest

from gradysim.integrated.engine_defaults import engine_defaults
from gradysim.integrated.ini_terms import FIELD, in_ini_terms, key_name, keys_by_target


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("radio.energy_detection_w = 1", "wlan[*].radio.receiver.energyDetection"),
        ("wlan[1].radio.carrier_hz = 1", "wlan[1].radio.centerFrequency"),
        ("medium.background_noise_w", "radioMedium.backgroundNoise.power"),
        ("mobility.typename", "mobility.typename"),
        ("protocol.payload_bytes = 3", "protocol.payload_bytes"),
    ],
)
def test_fields_have_the_names_of_their_keys(text, name):
    assert key_name(FIELD.search(text)) == name


@pytest.mark.parametrize(
    ("text", "target", "told"),
    [
        ("3.1622776601683794e-12 W", "radio.energy_detection_w", "-85dBm"),
        ("0 W to 1000000000000 W", "radio.tx_power_w", "0mW to 1000GW"),
        ("0.02 W", "radio.tx_power_w", "20mW"),
        ("1000 Hz", "radio.bandwidth_hz", "1kHz"),
        ("2412000000 Hz", "radio.carrier_hz", "2412MHz"),
        ("6.280044 rad", "antenna.beam_width_rad", "359.82deg"),
        ("0.50118723362727224: expected at least 1", "radio.capture_margin", "-3dB: expected at least 0dB"),
        ("0 B to 2276 B", "protocol.payload_bytes", "0B to 2276B"),
        ("0.0001 s", "", "100us"),
        ("50 m: even of 1000000000000 W", "", "50m: even of 1000GW"),
        ("3 interfaces, from wlan[0] on", "", "3 interfaces, from wlan[0] on"),
        ("rates 6, 9 and 12 Mbps", "mac.bitrate_bps", "rates 6, 9 and 12 Mbps"),
        ("-20 dB", "medium.sigma_db", "-20dB"),
        ("300 dB: expected at most 100 dB", "medium.k_db", "300dB: expected at most 100dB"),
        ("5 m/s", "mobility.speed_mps", "5mps"),
    ],
)
def test_quantities_are_in_the_units_of_the_key(text, target, told):
    assert in_ini_terms(text, target) == told


def test_every_field_of_the_engine_that_a_key_sets_is_recognised():
    targets = [target for target in keys_by_target() if target.partition(".")[0] in engine_defaults()]
    assert len(targets) > 60
    assert [target for target in targets if not FIELD.fullmatch(target)] == []
