"""Keys of rate control, and the counts of frames by bitrate in the results."""

from collections.abc import Callable

import pytest

from gradysim.integrated.run import run
from gradysim.scenario.errors import ConfigError
from gradysim.scenario.scenario import Scenario

SENDER = """
class Tested(Quiet):
    def initialize(self):
        if self.provider.get_id() == 0:
            for number in range(30):
                self.provider.send_communication_command(SendMessageCommand("x", 1))
"""


def test_the_keys_reach_the_engine(make_scenario: Callable[..., Scenario]) -> None:
    scenario = make_scenario(
        SENDER,
        '**.opMode = "g(erp)"',
        '**.rateControl.typename = "ArfRateControl"',
        "**.rateControl.initialRate = 9Mbps",
        "**.rateControl.increaseThreshold = 5",
    )
    sender = run(scenario).nodes[0]
    expected = {9: 5, 12: 5, 18: 5, 24: 5, 36: 5, 48: 5}
    assert {
        int(rate / 1e6): frames for rate, frames in sender.frames_by_bitrate.items() if frames
    } == expected
    assert sender.to_json_object()["frames_by_bitrate"] == {
        str(mbps * 1_000_000): expected.get(mbps, 0) for mbps in (6, 9, 12, 18, 24, 36, 48, 54)
    }


def test_without_rate_control_frames_are_not_counted_by_bitrate(
    make_scenario: Callable[..., Scenario],
) -> None:
    sender = run(make_scenario(SENDER)).nodes[0]
    assert sender.frames_by_bitrate == {}
    assert "frames_by_bitrate" not in sender.to_json_object()


@pytest.mark.parametrize(
    ("setting", "text"),
    [
        ('**.rateControl.typename = "AarfControl"', "AarfRateControl"),
        ("**.rateControl.initialRate = 11Mbps", " 12 Mbps"),
        ("**.rateControl.lookAroundRate = 2", " 0 .* 1"),
        ("**.rateControl.maxIncreaseThreshold = 5", "maxIncreaseThreshold, 5"),
    ],
)
def test_a_wrong_value_is_refused_with_what_was_expected(
    make_scenario: Callable[..., Scenario], setting: str, text: str
) -> None:
    with pytest.raises(ConfigError, match=text):
        run(
            make_scenario(
                SENDER, setting, '**.opMode = "g(erp)"', '**.rateControl.typename = "AarfRateControl"'
            )
        )
