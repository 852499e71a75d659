"""The error of the position that a node knows."""

import math

import pytest

from gradysim.motion.position_error import position_error


@pytest.mark.parametrize("ratio", [1.0, 2.3])
def test_the_height_may_be_less_exact_than_the_place(ratio: float) -> None:
    error = position_error(1, 0, 2.0, 5.0, ratio)
    axes = list(zip(*(error.at(float(number)) for number in range(5000)), strict=True))
    deviations = [math.hypot(*axis) / math.sqrt(len(axis)) for axis in axes]
    assert deviations == pytest.approx([2, 2, 2 * ratio], rel=0.1)


def test_each_node_has_its_own() -> None:
    assert position_error(1, 0, 1.0, 30.0).at(0.0) != position_error(1, 1, 1.0, 30.0).at(0.0)
