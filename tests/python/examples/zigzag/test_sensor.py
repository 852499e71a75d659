from collections.abc import Callable
from typing import Any

import pytest

from message import GroundHeartbeat, Message, PairRequest, SensorData, UavHeartbeat
from sensor import ZigZagSensor


def test_a_heartbeat_of_a_uav_is_answered_to_that_uav(bench: Callable[..., Any]) -> None:
    sensor = bench(ZigZagSensor, 5)
    assert sensor.hear(UavHeartbeat(1, homeward=False, available=True)) == [(SensorData(sender=5), 1)]


def test_a_uav_that_ignores_other_uavs_gets_its_reading(bench: Callable[..., Any]) -> None:
    sensor = bench(ZigZagSensor, 5)
    assert len(sensor.hear(UavHeartbeat(1, homeward=True, available=False))) == 1


@pytest.mark.parametrize("message", [GroundHeartbeat(9), PairRequest(1, 1, 0), SensorData(6)])
def test_nothing_else_is_answered(bench: Callable[..., Any], message: Message) -> None:
    assert bench(ZigZagSensor, 5).hear(message) == []


def test_readings_are_counted(bench: Callable[..., Any]) -> None:
    sensor = bench(ZigZagSensor, 5)
    heartbeat = UavHeartbeat(1, homeward=False, available=True)
    sensor.hear(heartbeat, heartbeat)
    assert sensor.tracked == {"answered": 2}
