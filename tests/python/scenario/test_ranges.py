import math
import sys
from typing import Any

import pytest

from gradysim.scenario.ranges import mean_range_m, ranges_of_prototype_m

RANGE = "*.*.wlan[*].radio.transmitter.communicationRange = 90m\n"
POWER = "*.*.wlan[*].radio.transmitter.power = 1mW\n"
OWN = "*.communicationMedium.transmissionRange = 70m\n"
DISK = '*.radioMedium.typename = "UnitDiskRadioMedium"\n'


@pytest.mark.parametrize(
    ("lines", "range_m"),
    [
        ("", 60),
        (RANGE, 90),
        (RANGE + OWN, 70),
        (RANGE + POWER, 90),
        (POWER + RANGE, 60),  # the power is in force
        (DISK + POWER + RANGE, 90),
    ],
)
def test_the_range_in_prototype_mode(folder: Any, lines: str, range_m: float) -> None:
    assert set(ranges_of_prototype_m(folder.load(lines))) == {range_m}


def test_the_mean_leaves_out_what_is_unknown_and_unlimited() -> None:
    assert mean_range_m([10.0, 30.0, None, math.inf]) == 20
    assert mean_range_m([math.inf]) is None


def test_the_mean_of_the_largest_ranges_is_finite() -> None:
    assert mean_range_m([sys.float_info.max] * 3) == sys.float_info.max
