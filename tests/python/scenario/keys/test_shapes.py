import math

import pytest

from gradysim.scenario.errors.config_error import BadValue
from gradysim.scenario.expressions import parse_value
from gradysim.scenario.keys.key import Key, ReadBy
from gradysim.scenario.keys.shapes import Below, angle, bit_rate, level
from gradysim.scenario.parameter_types import ParameterType


def test_a_key_stands_below_its_path_and_goes_to_its_struct() -> None:
    kind = angle()
    key = Below("wlan[0].radio", "radio")("tilt", "tilt_rad", kind, "How it is tilted", default="0deg")
    assert key == Key("wlan[0].radio.tilt", "radio.tilt_rad", kind, "How it is tilted", "0deg")


def test_keys_further_down_stay_with_the_same_struct_and_models() -> None:
    radio = Below("wlan[0].radio", "radio").only_for("medium.typename", "Air", "Vacuum")
    key = radio.below("receiver")("level", "level_w", level(), "From where on it hears")
    assert (key.path, key.target) == ("wlan[0].radio.receiver.level", "radio.level_w")
    assert key.read_by == ReadBy("medium.typename", ("Air", "Vacuum"), "Air, Vacuum")


def test_models_may_have_another_name_in_lists() -> None:
    assert Below("mac", "mac").only_for("mac.typename", "LongName", shown="short").read_by == ReadBy(
        "mac.typename", ("LongName",), "short"
    )


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
    kind: ParameterType, text: str, value: float, written: str
) -> None:
    assert kind.convert(parse_value(text)) == pytest.approx(value)
    assert kind.show(value) == written


@pytest.mark.parametrize(("kind", "text"), [(bit_rate(), "0bps"), (bit_rate(), "-2bps"), (level(), "0W")])
def test_what_no_model_could_mean_is_refused(kind: ParameterType, text: str) -> None:
    with pytest.raises(BadValue):
        kind.convert(parse_value(text))


@pytest.mark.parametrize(("kind", "text"), [(level(), "85dBm"), (level(zero=True), "2W")])
def test_a_level_without_its_minus_is_refused(kind: ParameterType, text: str) -> None:
    with pytest.raises(BadValue, match=f"`{text}` is more than any radio receives; a minus forgotten"):
        kind.convert(parse_value(text))
    assert kind.expected.endswith("0W and at most 1W")


@pytest.mark.parametrize(("kind", "text"), [(level(), "1W"), (level(), "-85dBm"), (level(zero=True), "0W")])
def test_a_level_may_make_a_radio_deaf(kind: ParameterType, text: str) -> None:
    assert float(kind.convert(parse_value(text))) <= 1
