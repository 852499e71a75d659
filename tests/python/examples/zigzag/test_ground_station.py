from collections.abc import Callable
from typing import Any

import pytest

from ground_station import ZigZagGroundStation
from message import GroundHeartbeat, Message, PairConfirmation, PairRequest, SensorData, UavHeartbeat


def test_it_advertises_itself_every_interval(bench: Callable[..., Any]) -> None:
    station = bench(ZigZagGroundStation, 7, heartbeat_interval=2.0, heartbeat_jitter=0.0)
    for time in (2.0, 4.0, 6.0):
        station.next_timer()
        assert station.provider.now == time
        assert station.drain() == [(GroundHeartbeat(7), None)]


def test_an_available_uav_is_asked_for_its_data(bench: Callable[..., Any]) -> None:
    station = bench(ZigZagGroundStation, 7)
    assert station.hear(UavHeartbeat(1, homeward=True, available=True)) == [
        (PairRequest(7, carrier=7, given=0), 1)
    ]


@pytest.mark.parametrize(
    "message", [UavHeartbeat(1, homeward=True, available=False), GroundHeartbeat(8), SensorData(5)]
)
def test_nobody_else_is_asked(bench: Callable[..., Any], message: Message) -> None:
    assert bench(ZigZagGroundStation, 7).hear(message) == []


def test_a_request_is_always_confirmed_and_its_data_taken(bench: Callable[..., Any]) -> None:
    station = bench(ZigZagGroundStation, 7)
    for uav, given in ((0, 12), (1, 5), (0, 20)):
        assert station.hear(PairRequest(uav, carrier=7, given=given)) == [
            (PairConfirmation(7, carrier=7, given=0), uav)
        ]
    assert station.tracked == {"data": 25, "deliveries": 3}


def test_data_comes_with_a_confirmation_too(bench: Callable[..., Any]) -> None:
    station = bench(ZigZagGroundStation, 7)
    assert station.hear(PairConfirmation(1, carrier=7, given=12)) == []
    assert station.tracked == {"data": 12, "deliveries": 1}


def test_an_exchange_without_data_is_no_delivery(bench: Callable[..., Any]) -> None:
    station = bench(ZigZagGroundStation, 7)
    station.hear(PairRequest(1, carrier=7, given=12), PairRequest(1, carrier=7, given=12))
    assert station.tracked == {"data": 12, "deliveries": 1}
