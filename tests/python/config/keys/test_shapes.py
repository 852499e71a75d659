import math

import pytest

from gradysim.config.error import BadValue
from gradysim.config.expression import parse_value
from gradysim.config.key import Key
from gradysim.config.keys.shapes import Below, angle, bit_rate, level
from gradysim.config.kinds import Kind


def test_a_key_stands_below_its_path_and_goes_to_its_struct() -> None:
    kind = angle()
    key = Below("wlan[0].radio", "radio")("tilt", "tilt_rad", kind, "How it is tilted", default="0deg")
    assert key == Key("wlan[0].radio.tilt", "radio.tilt_rad", kind, "How it is tilted", "0deg")


@pytest.mark.parametrize(
    ("kind", "text", "value", "written"),
    [
        (angle(), "-90deg", -math.pi / 2, "-90deg"),
        (bit_rate(), "6Mbps", 6e6, "6Mbps"),
        (bit_rate(), "-1bps", -1.0, "-1bps"),
        (level(), "-30dBm", 1e-6, "-30dBm"),
    ],
)
def test_values_come_in_si_units_and_are_shown_in_those_of_the_field(
    kind: Kind, text: str, value: float, written: str
) -> None:
    assert kind.convert(parse_value(text)) == pytest.approx(value)
    assert kind.show(value) == written


@pytest.mark.parametrize(("kind", "text"), [(bit_rate(), "0bps"), (bit_rate(), "-2bps"), (level(), "0W")])
def test_what_no_model_could_mean_is_refused(kind: Kind, text: str) -> None:
    with pytest.raises(BadValue):
        kind.convert(parse_value(text))
