"""The error of the position that a node knows."""

import math

import pytest

from gradysim.motion.position_error import position_error


def test_the_height_is_less_exact_than_the_place() -> None:
    error = position_error(1, 0, 2.0, 5.0)
    axes = list(zip(*(error.at(float(number)) for number in range(5000)), strict=True))
    deviations = [math.hypot(*axis) / math.sqrt(len(axis)) for axis in axes]
    assert deviations == pytest.approx([2, 2, 3], rel=0.1)


def test_each_node_has_its_own() -> None:
    assert position_error(1, 0, 1.0, 30.0).at(0.0) != position_error(1, 1, 1.0, 30.0).at(0.0)
