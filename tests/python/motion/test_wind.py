"""The wind at a vehicle."""

import math

import pytest

from gradysim.motion.wind import Wind, WindAtVehicle


def test_its_heading_is_where_the_air_moves() -> None:
    wind = WindAtVehicle(Wind(5.0, math.pi / 2), 1, 0)
    assert wind.velocity_mps(3.0) == pytest.approx((0, 5, 0), abs=1e-12)


def test_each_vehicle_has_its_own_gusts() -> None:
    first, second = (WindAtVehicle(Wind(gusts_mps=2.0), 1, node) for node in range(2))
    assert first.velocity_mps(1.0) != second.velocity_mps(1.0)


def test_gusts_deviate_from_the_constant_wind() -> None:
    wind = WindAtVehicle(Wind(5.0, 0.0, 2.0, 1.0), 1, 0)
    off = [wind.velocity_mps(0.5 * number)[0] - 5 for number in range(5000)]
    assert sum(off) / len(off) == pytest.approx(0, abs=0.2)
    assert math.hypot(*off) / math.sqrt(len(off)) == pytest.approx(2, rel=0.05)
