import pytest

pytest.importorskip("gradysim._netsim")

from gradysim.integrated.ranges import lint_ranges, ranges_m

RANGE = "*.*.wlan[*].radio.transmitter.communicationRange = 90m"
POWER = "*.*.wlan[*].radio.transmitter.power = 1mW"


def own(range_m):
    return f"*.communicationMedium.transmissionRange = {range_m}m"


def test_a_power_has_the_range_that_it_was_set_for(make_scenario):
    assert ranges_m(make_scenario("class Tested(Quiet): pass", RANGE)) == pytest.approx([90, 90])


@pytest.mark.parametrize(
    ("lines", "mode", "key"),
    [
        ([], "prototype", None),
        ([RANGE], "prototype", None),
        ([RANGE, own(88)], "integrated", None),
        ([RANGE, own(60)], "integrated", "*.communicationMedium.transmissionRange"),
        ([own(60)], "prototype", "*.communicationMedium.transmissionRange"),
        ([POWER], "integrated", None),
        ([POWER], "prototype", "*.*.wlan[*].radio.transmitter.power"),
        ([POWER, own(176)], "prototype", None),
    ],
)
def test_ranges_that_differ_are_told_at_their_line(make_scenario, lines, mode, key):
    found = lint_ranges([make_scenario("class Tested(Quiet): pass", *lines)], mode)
    assert [finding.key for finding in found] == ([key] if key else [])
