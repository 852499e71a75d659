"""Whole exchanges between several UAVs and a ground station, in any order and with any losses.

Invariant: exactly one node holds a collected reading, or it is in transit between two nodes, handed over in a
lost message. No reading exists twice. Without losses none is in transit.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from gradysim.protocol.messages.telemetry import Telemetry
from ground_station import ZigZagGroundStation
from message import SensorData, UavHeartbeat
from mobile import ZigZagMobile

UAVS = 4
STATION = UAVS


@dataclass
class Fleet:
    """UAVs and a ground station. `lose` returns for one message after the other whether it is lost."""

    nodes: list[Any]
    lose: Iterator[bool] = field(default_factory=lambda: iter(()))

    def pass_time(self, seconds: float) -> None:
        for node in self.nodes:
            node.provider.now += seconds

    def collect(self, uav: int, readings: int) -> None:
        self.nodes[uav].hear(*[SensorData(99)] * readings)

    def send_heartbeat(self, sender: int, hearers: set[int]) -> None:
        """Send a heartbeat of a node to the nodes in range, and deliver all answers."""
        node = self.nodes[sender]
        node.drain()
        node.protocol.handle_timer("heartbeat")
        ((heartbeat, _),) = node.drain()
        under_way = [(heartbeat, hearer) for hearer in sorted(hearers - {sender})]
        while under_way:
            message, receiver = under_way.pop(0)
            if not next(self.lose, False):
                under_way += self.nodes[receiver].hear(message)

    def held(self) -> list[int]:
        return [node.protocol._custody.held for node in self.nodes]

    def collected(self) -> int:
        return sum(node.tracked["collected"] for node in self.nodes[:UAVS])

    def in_transit(self) -> list[int]:
        accounts = [node.protocol._custody for node in self.nodes]
        return [
            accounts[a].given_to(b) - accounts[b].taken_from(a)
            for a in range(len(accounts))
            for b in range(len(accounts))
            if a != b
        ]

    def homeward(self, uav: int) -> bool:
        reversed_: bool = self.nodes[uav].protocol._mission.is_reversed
        return reversed_


@pytest.fixture
def fleet(bench: Callable[..., Any]) -> Callable[..., Fleet]:
    """`fleet(homeward=[...])`: UAVs between two sensors; those numbers fly towards the ground station."""

    def start(homeward: list[int], **parameters: object) -> Fleet:
        uavs = [bench(ZigZagMobile, uav, launch_interval=0.0, **parameters) for uav in range(UAVS)]
        for number, uav in enumerate(uavs):
            uav.next_timer()
            for stop in (0, 1, 2, 3, 4, 5) if number in homeward else (0, 1):
                uav.protocol.handle_telemetry(Telemetry((stop * 300.0, 0.0, 20.0 + number)))
        subject = Fleet([*uavs, bench(ZigZagGroundStation, STATION)])
        subject.pass_time(5.0)  # they ignore each other after the launch
        return subject

    return start


NODES = st.integers(0, STATION)
STEPS = st.lists(
    st.one_of(
        st.tuples(st.just("collect"), st.integers(0, UAVS - 1), st.integers(1, 9)),
        st.tuples(st.just("heartbeat"), NODES, st.sets(NODES, max_size=3)),
        st.tuples(st.just("pass time"), st.sampled_from([0.5, 1.0, 6.0]), st.none()),
    ),
    max_size=60,
)
PARAMETERS = st.fixed_dictionaries({"interaction_timeout": st.sampled_from([0.0, 5.0])})
EACH_EXAMPLE_STARTS_A_FLEET = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])


def play(fleet: Fleet, steps: list[Any], after_each: Callable[[], None]) -> None:
    for what, first, second in steps:
        match what:
            case "collect":
                fleet.collect(first, second)
            case "heartbeat":
                fleet.send_heartbeat(first, second)
            case "pass time":
                fleet.pass_time(first)
        after_each()


@EACH_EXAMPLE_STARTS_A_FLEET
@given(homeward=st.lists(st.integers(0, UAVS - 1)), parameters=PARAMETERS, steps=STEPS)
def test_on_a_perfect_channel_no_reading_is_created_or_destroyed(
    fleet: Callable[..., Fleet], homeward: list[int], parameters: dict[str, Any], steps: list[Any]
) -> None:
    subject = fleet(homeward, **parameters)

    def check() -> None:
        assert sum(subject.held()) == subject.collected()
        assert set(subject.in_transit()) == {0}

    play(subject, steps, check)


@EACH_EXAMPLE_STARTS_A_FLEET
@given(
    homeward=st.lists(st.integers(0, UAVS - 1)),
    parameters=PARAMETERS,
    steps=STEPS,
    losses=st.lists(st.booleans(), max_size=200),
)
def test_whatever_is_lost_each_reading_is_held_once_or_in_transit(
    fleet: Callable[..., Fleet],
    homeward: list[int],
    parameters: dict[str, Any],
    steps: list[Any],
    losses: list[bool],
) -> None:
    subject = fleet(homeward, **parameters)
    subject.lose = iter(losses)

    def check() -> None:
        assert min(subject.in_transit()) >= 0
        assert sum(subject.held()) + sum(subject.in_transit()) == subject.collected()

    play(subject, steps, check)


@EACH_EXAMPLE_STARTS_A_FLEET
@given(pair=st.sampled_from([(0, 1), (1, 0), (2, 3), (3, 2)]), homeward=st.lists(st.integers(0, UAVS - 1)))
def test_two_uavs_that_met_fly_apart_and_the_one_that_flies_home_has_all(
    fleet: Callable[..., Fleet], pair: tuple[int, int], homeward: list[int]
) -> None:
    subject = fleet(homeward)
    for uav in pair:
        subject.collect(uav, 5)
    subject.send_heartbeat(pair[0], {pair[1]})
    carrier, other = sorted(pair, key=lambda uav: -subject.held()[uav])
    assert (subject.held()[carrier], subject.held()[other]) == (10, 0)
    assert (subject.homeward(carrier), subject.homeward(other)) == (True, False)


@pytest.mark.parametrize("sender", [0, STATION])
@pytest.mark.parametrize("homeward", [[], [0]])
def test_the_ground_station_gets_all_and_the_uav_flies_away(
    fleet: Callable[..., Fleet], sender: int, homeward: list[int]
) -> None:
    subject = fleet(homeward)
    subject.collect(0, 5)
    subject.send_heartbeat(sender, {0, STATION})
    assert (subject.held()[0], subject.held()[STATION]) == (0, 5)
    assert not subject.homeward(0)


class TestLoss:
    """UAV 0 flies outward, UAV 1 homeward with data; UAV 0 hears or sends the first heartbeat."""

    @pytest.mark.parametrize(("sender", "hearer"), [(0, 1), (1, 0)])
    def test_a_lost_request_turns_nobody_around(
        self, fleet: Callable[..., Fleet], sender: int, hearer: int
    ) -> None:
        subject = fleet([1])
        subject.lose = iter([False, True])
        subject.send_heartbeat(sender, {hearer})
        assert (subject.homeward(0), subject.homeward(1)) == (False, True)

    @pytest.mark.parametrize(("sender", "hearer"), [(0, 1), (1, 0)])
    def test_the_next_heartbeat_makes_a_lost_request_good(
        self, fleet: Callable[..., Fleet], sender: int, hearer: int
    ) -> None:
        subject = fleet([1])
        subject.collect(1, 5)
        subject.lose = iter([False, True])
        subject.send_heartbeat(sender, {hearer})
        subject.send_heartbeat(sender, {hearer})
        assert subject.held()[:2] == [5, 0]
        assert (subject.homeward(0), subject.homeward(1)) == (True, False)

    @pytest.mark.parametrize(("sender", "hearer"), [(0, 1), (1, 0)])
    def test_an_exchange_after_the_timeout_makes_a_lost_confirmation_good(
        self, fleet: Callable[..., Fleet], sender: int, hearer: int
    ) -> None:
        subject = fleet([1])
        subject.collect(1, 5)
        subject.lose = iter([False, False, True])
        subject.send_heartbeat(sender, {hearer})
        assert subject.homeward(0) == subject.homeward(1)
        subject.pass_time(5.0)
        subject.send_heartbeat(sender, {hearer})
        assert subject.homeward(0) != subject.homeward(1)
        assert sum(subject.held()) == 5


def test_a_heartbeat_says_where_the_uav_flies_to(fleet: Callable[..., Fleet]) -> None:
    subject = fleet([2])
    for number in range(UAVS):
        node = subject.nodes[number]
        node.protocol.handle_timer("heartbeat")
        assert node.drain() == [(UavHeartbeat(number, homeward=number == 2, available=True), None)]
