from collections.abc import Callable
from typing import Any

import pytest

from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand, SetSpeedMobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from message import (
    GroundHeartbeat,
    Message,
    PairConfirmation,
    PairRequest,
    SensorData,
    UavHeartbeat,
)
from mobile import ZigZagMobile

STATION = 9


@pytest.fixture
def flying(bench: Callable[..., Any]) -> Callable[..., Any]:
    """`flying(node_id, homeward, data, **parameters)`: a UAV in flight between two sensors."""

    def start(node_id: int = 1, homeward: bool = False, data: int = 0, **parameters: object) -> Any:
        uav = bench(ZigZagMobile, node_id, **parameters)
        while uav.next_timer() != "launch":
            pass
        stops = (0, 1, 2, 3, 4, 5, 4) if homeward else (0, 1)
        for stop in stops:
            uav.protocol.handle_telemetry(Telemetry((stop * 300.0, 0.0, 20.0 + node_id)))
        uav.hear(*[SensorData(5)] * data)
        uav.provider.now += 5.0
        uav.provider.timers = [("heartbeat", uav.provider.now + 1.0)]
        uav.provider.moves.clear()
        return uav

    return start


def direction(uav: Any) -> str:
    """Return the direction in the next heartbeat."""
    uav.drain()
    while uav.next_timer() != "heartbeat":
        pass
    ((heartbeat, destination),) = uav.drain()
    assert destination is None
    return "homeward" if heartbeat.homeward else "outward"


class TestLaunch:
    @pytest.mark.parametrize("node_id", [0, 1, 4])
    def test_uavs_are_launched_one_by_one(self, bench: Callable[..., Any], node_id: int) -> None:
        uav = bench(ZigZagMobile, node_id, launch_interval=20.0)
        assert uav.next_timer() == "launch"
        assert uav.provider.now == node_id * 20.0

    def test_the_mission_leads_over_every_sensor(self, bench: Callable[..., Any]) -> None:
        uav = bench(ZigZagMobile, 2, sensor_count=3, sensor_spacing=100.0, altitude=30.0, altitude_step=2.0)
        uav.next_timer()
        for stop in range(4):
            uav.protocol.handle_telemetry(Telemetry((stop * 100.0, 0.0, 34.0)))
        targets = [move for move in uav.provider.moves if isinstance(move, GotoCoordsMobilityCommand)]
        assert targets == [GotoCoordsMobilityCommand(x, 0.0, 34.0) for x in (0.0, 100.0, 200.0, 300.0, 200.0)]

    def test_it_flies_with_its_speed(self, bench: Callable[..., Any]) -> None:
        uav = bench(ZigZagMobile, 0, speed=7.0)
        uav.next_timer()
        assert SetSpeedMobilityCommand(7.0) in uav.provider.moves

    @pytest.mark.parametrize(
        "message",
        [
            SensorData(5),
            GroundHeartbeat(STATION),
            UavHeartbeat(0, homeward=True, available=True),
            PairRequest(0, carrier=0, given=3),
        ],
    )
    def test_before_that_it_neither_hears_nor_speaks(
        self, bench: Callable[..., Any], message: Message
    ) -> None:
        uav = bench(ZigZagMobile, 3)
        assert uav.hear(message) == []
        assert uav.tracked == {"data": 0, "collected": 0, "interactions": 0}
        assert [name for name, _ in uav.provider.timers] == ["launch"]

    def test_then_it_leaves_the_others_alone_first(self, bench: Callable[..., Any]) -> None:
        uav = bench(ZigZagMobile, 0, interaction_timeout=5.0)
        uav.next_timer()
        assert uav.hear(GroundHeartbeat(STATION)) == []
        uav.provider.now += 5.0
        assert len(uav.hear(GroundHeartbeat(STATION))) == 1


class TestHeartbeats:
    def test_they_go_out_every_interval_after_the_launch(self, bench: Callable[..., Any]) -> None:
        timing = {"launch_interval": 30.5, "heartbeat_interval": 2.0, "heartbeat_jitter": 0.0}
        uav = bench(ZigZagMobile, 1, **timing)
        assert uav.next_timer() == "launch"
        for time in (32.0, 34.0, 36.0):
            assert uav.next_timer() == "heartbeat"
            assert uav.provider.now == time
            ((heartbeat, destination),) = uav.drain()
            assert (heartbeat.sender, heartbeat.homeward, destination) == (1, False, None)

    def test_with_jitter_no_two_uavs_send_at_the_same_instant(self, bench: Callable[..., Any]) -> None:
        uavs = [bench(ZigZagMobile, node_id, launch_interval=0.0) for node_id in range(4)]
        instants = set()
        for uav in uavs:
            uav.next_timer()
            for _ in range(10):
                uav.next_timer()
                instants.add(uav.provider.now)
        assert len(instants) == 40

    def test_they_go_on_during_the_timeout_and_say_so(self, flying: Callable[..., Any]) -> None:
        uav = flying()
        uav.hear(PairConfirmation(0, carrier=0, given=0))
        uav.next_timer()
        assert uav.drain() == [(UavHeartbeat(1, homeward=False, available=False), None)]


def test_each_reading_of_a_sensor_counts_one(flying: Callable[..., Any]) -> None:
    uav = flying()
    assert uav.hear(SensorData(5), SensorData(5), SensorData(6)) == []
    assert uav.tracked == {"data": 3, "collected": 3, "interactions": 0}


class TestCarrier:
    """The answer to a heartbeat is a request that names the carrier."""

    @pytest.mark.parametrize(
        ("own_id", "own_homeward", "peer_homeward", "carrier"),
        [
            (1, False, True, 1),
            (1, True, False, 2),
            (1, False, False, 1),
            (3, False, False, 2),
            (1, True, True, 1),
            (3, True, True, 2),
        ],
    )
    def test_it_is_the_one_that_flies_outward_or_has_the_lower_id(
        self, flying: Callable[..., Any], own_id: int, own_homeward: bool, peer_homeward: bool, carrier: int
    ) -> None:
        uav = flying(own_id, homeward=own_homeward)
        ((request, destination),) = uav.hear(UavHeartbeat(2, homeward=peer_homeward, available=True))
        assert (request, destination) == (PairRequest(own_id, carrier=carrier, given=0), 2)

    @pytest.mark.parametrize("homeward", [False, True])
    def test_it_is_always_the_ground_station(self, flying: Callable[..., Any], homeward: bool) -> None:
        uav = flying(homeward=homeward)
        assert uav.hear(GroundHeartbeat(STATION)) == [(PairRequest(1, carrier=STATION, given=0), STATION)]


class TestExchange:
    def test_who_asks_the_carrier_gives_all_at_once(self, flying: Callable[..., Any]) -> None:
        uav = flying(homeward=True, data=7)
        ((request, _),) = uav.hear(UavHeartbeat(2, homeward=False, available=True))
        assert request.given == 7
        assert uav.tracked["data"] == 0

    def test_who_asks_turns_around_when_that_is_confirmed(self, flying: Callable[..., Any]) -> None:
        uav = flying(homeward=True)
        uav.hear(UavHeartbeat(2, homeward=False, available=True))
        assert direction(uav) == "homeward"
        uav.hear(PairConfirmation(2, carrier=2, given=0))
        assert direction(uav) == "outward"

    def test_who_asks_as_the_carrier_gets_the_data_with_the_confirmation(
        self, flying: Callable[..., Any]
    ) -> None:
        uav = flying(data=2)
        uav.hear(UavHeartbeat(2, homeward=True, available=True), PairConfirmation(2, carrier=1, given=7))
        assert uav.tracked == {"data": 9, "collected": 2, "interactions": 1}
        assert direction(uav) == "homeward"

    def test_who_is_asked_to_carry_takes_confirms_and_turns(self, flying: Callable[..., Any]) -> None:
        uav = flying(data=2)
        assert uav.hear(PairRequest(2, carrier=1, given=7)) == [(PairConfirmation(1, carrier=1, given=0), 2)]
        assert uav.tracked == {"data": 9, "collected": 2, "interactions": 1}
        assert direction(uav) == "homeward"

    def test_who_is_asked_to_give_does_so_with_the_confirmation(self, flying: Callable[..., Any]) -> None:
        uav = flying(homeward=True, data=7)
        assert uav.hear(PairRequest(2, carrier=2, given=0)) == [(PairConfirmation(1, carrier=2, given=7), 2)]
        assert uav.tracked["data"] == 0
        assert direction(uav) == "outward"

    def test_two_that_ask_each_other_agree(self, flying: Callable[..., Any]) -> None:
        left, right = flying(1, data=2), flying(2, homeward=True, data=7)
        ((left_asks, _),) = left.hear(UavHeartbeat(2, homeward=True, available=True))
        ((right_asks, _),) = right.hear(UavHeartbeat(1, homeward=False, available=True))
        ((left_confirms, _),) = left.hear(right_asks)
        ((right_confirms, _),) = right.hear(left_asks)
        assert left.hear(right_confirms) == right.hear(left_confirms) == []
        assert (left.tracked["data"], right.tracked["data"]) == (9, 0)
        assert (direction(left), direction(right)) == ("homeward", "outward")
        assert (left.tracked["interactions"], right.tracked["interactions"]) == (1, 1)


class TestTimeout:
    def interrupted(self, flying: Callable[..., Any], **parameters: object) -> Any:
        uav = flying(data=2, **parameters)
        uav.hear(PairRequest(2, carrier=1, given=7))
        return uav

    @pytest.mark.parametrize(
        "message",
        [
            GroundHeartbeat(STATION),
            UavHeartbeat(3, homeward=False, available=True),
            PairRequest(3, carrier=3, given=0),
            PairConfirmation(3, carrier=3, given=0),
        ],
    )
    def test_after_an_exchange_others_are_ignored(self, flying: Callable[..., Any], message: Message) -> None:
        uav = self.interrupted(flying)
        assert uav.hear(message) == []
        assert uav.tracked == {"data": 9, "collected": 2, "interactions": 1}
        assert direction(uav) == "homeward"

    def test_sensors_are_not(self, flying: Callable[..., Any]) -> None:
        uav = self.interrupted(flying)
        uav.hear(SensorData(5))
        assert uav.tracked["data"] == 10

    def test_data_that_was_handed_over_is_taken_all_the_same(self, flying: Callable[..., Any]) -> None:
        uav = self.interrupted(flying)
        assert uav.hear(PairRequest(3, carrier=1, given=4)) == []
        assert uav.tracked["data"] == 13

    def test_it_ends(self, flying: Callable[..., Any]) -> None:
        uav = self.interrupted(flying, interaction_timeout=3.0)
        uav.provider.now += 2.999
        assert uav.hear(GroundHeartbeat(STATION)) == []
        uav.provider.now += 0.001
        assert len(uav.hear(GroundHeartbeat(STATION))) == 1

    def test_without_it_the_next_heartbeat_starts_the_next_exchange(self, flying: Callable[..., Any]) -> None:
        uav = self.interrupted(flying, interaction_timeout=0.0)
        assert len(uav.hear(UavHeartbeat(2, homeward=False, available=True))) == 1

    def test_who_is_not_available_is_not_asked(self, flying: Callable[..., Any]) -> None:
        uav = flying(homeward=True, data=7)
        assert uav.hear(UavHeartbeat(2, homeward=False, available=False)) == []
        assert uav.tracked["data"] == 7
