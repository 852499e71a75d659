"""ZigZag in prototype mode: 2 UAVs and 5 sensors for half an hour."""

import itertools
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import pytest

from gradysim.simulator.handler.communication import CommunicationHandler, CommunicationMedium
from gradysim.simulator.handler.mobility import MobilityConfiguration, MobilityHandler
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from ground_station import ZigZagGroundStation
from mobile import ZigZagMobile
from sensor import ZigZagSensor

UAVS = (0, 1)
SENSORS = (2, 3, 4, 5, 6)
STATION = 7
DURATION_S = 1800.0


@dataclass
class Flight:
    """Observations of a run: the nodes at its end, and some values over time."""

    nodes: list[Any]
    times: list[float] = field(default_factory=list)
    places: list[tuple[float, float]] = field(default_factory=list)
    """Distance of each UAV from the ground station along the line of sensors, m."""
    arrived: list[int] = field(default_factory=list)

    def tracked(self, node_id: int) -> dict[str, Any]:
        variables: dict[str, Any] = self.nodes[
            node_id
        ].protocol_encapsulator.protocol.provider.tracked_variables
        return variables

    def at(self, time: float) -> int:
        """Return the index of the last observation up to that time."""
        return max(index for index, seen in enumerate(self.times) if seen <= time)

    def mean_distance(self) -> float:
        """Return the mean distance between the UAVs along the line, m."""
        return sum(abs(first - second) for first, second in self.places) / len(self.places)


@cache
def fly(jitter: float = 0.1, timeout: float = 5.0, launch_interval: float = 30.0) -> Flight:
    class Mobile(ZigZagMobile):
        heartbeat_jitter = jitter
        interaction_timeout = timeout

    class Station(ZigZagGroundStation):
        heartbeat_jitter = jitter

    Mobile.launch_interval = launch_interval
    builder = SimulationBuilder(SimulationConfiguration(duration=DURATION_S, execution_logging=False, seed=1))
    builder.add_handler(TimerHandler())
    builder.add_handler(CommunicationHandler(CommunicationMedium(transmission_range=50)))
    builder.add_handler(MobilityHandler(MobilityConfiguration(update_rate=0.25)))
    ids = [builder.add_node(Mobile, (0.0, 1.0 + uav, 0.0)) for uav in UAVS]
    ids += [builder.add_node(ZigZagSensor, (300.0 * (1 + index), 0.0, 0.0)) for index in range(len(SENSORS))]
    ids.append(builder.add_node(Station, (0.0, 0.0, 0.0)))
    simulator = builder.build()
    flight = Flight([simulator.get_node(node_id) for node_id in ids])
    under_way = True
    while under_way:
        under_way = simulator.run_events(50)
        flight.times.append(simulator.current_time)
        flight.places.append((flight.nodes[0].position[0], flight.nodes[1].position[0]))
        flight.arrived.append(flight.tracked(STATION).get("data", 0))
    return flight


def test_ids_are_those_that_the_tests_assume() -> None:
    assert [node.id for node in fly().nodes] == [*UAVS, *SENSORS, STATION]


def test_data_of_every_sensor_is_collected() -> None:
    assert all(fly().tracked(sensor)["answered"] > 50 for sensor in SENSORS)


def test_most_data_has_arrived_at_the_ground_station() -> None:
    flight = fly()
    collected = sum(flight.tracked(uav)["collected"] for uav in UAVS)
    assert 0.8 * collected < flight.tracked(STATION)["data"] <= collected


def test_every_answer_of_a_sensor_is_held_by_one_node_in_the_end() -> None:
    flight = fly()
    answered = sum(flight.tracked(sensor)["answered"] for sensor in SENSORS)
    assert sum(flight.tracked(node)["data"] for node in (*UAVS, STATION)) == answered


def test_data_keeps_arriving() -> None:
    flight = fly()
    arrived = [flight.arrived[flight.at(time)] for time in (600.0, 900.0, 1200.0, 1500.0, 1800.0)]
    assert all(later - earlier > 100 for earlier, later in itertools.pairwise(arrived))


def test_uavs_are_launched_one_by_one() -> None:
    flight = fly()
    before, after = (flight.places[flight.at(time)] for time in (29.5, 60.0))
    assert before[0] > 250
    assert before[1] == 0
    assert after[0] - after[1] == pytest.approx(300, abs=10)


def test_without_stagger_uavs_stay_closer_to_each_other() -> None:
    assert fly(launch_interval=0.0).mean_distance() < 0.7 * fly().mean_distance()


def test_uavs_that_meet_turn_around_instead_of_passing_each_other() -> None:
    flight = fly()
    after_launch = flight.places[flight.at(60.0) :]
    assert all(first > second for first, second in after_launch)
    assert flight.tracked(0)["interactions"] > 10


def test_without_timeout_one_meeting_is_a_chain_of_interactions() -> None:
    assert fly(timeout=0.0).tracked(0)["interactions"] > 5 * fly().tracked(0)["interactions"]


def test_where_nothing_collides_heartbeats_at_the_same_instant_do_no_harm() -> None:
    synchronised, normal = fly(jitter=0.0), fly()
    assert synchronised.tracked(STATION)["data"] > 0.9 * normal.tracked(STATION)["data"]
