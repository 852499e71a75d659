"""Nodes with autopilots next to nodes without mass; the tests play the autopilots."""

import gc

import pytest

from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand
from gradysim.simulator.handler.mobility import MasslessMobilityConfiguration, MobilityException
from gradysim.simulator.handler.mobility.quadcopter import QuadcopterMobilityHandler
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from python.played_flights import PlayedFlights
from python.quiet_protocol import Quiet


class Tested(Quiet):
    def initialize(self):
        self.telemetry = []
        self.provider.schedule_timer("go", 0.2)

    def handle_timer(self, timer):
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(0, 7, 0))

    def handle_telemetry(self, telemetry):
        self.telemetry.append((self.provider.current_time(), telemetry.current_position))


@pytest.fixture
def flights():
    return PlayedFlights()


def built(flights, protocol=Tested):
    handler = QuadcopterMobilityHandler(MasslessMobilityConfiguration(update_rate=0.1), flights=flights)
    builder = SimulationBuilder(SimulationConfiguration(duration=0.5, execution_logging=False))
    builder.add_handler(TimerHandler()).add_handler(handler)
    builder.add_node(protocol, (9, 9, 9))
    builder.add_node(protocol, (0, 0, 0))
    simulator = builder.build()
    handler.take_off()
    return simulator


def protocols_of(simulator):
    return [node.protocol_encapsulator.protocol for node in simulator.nodes]


def test_a_flown_node_is_where_its_vehicle_is_and_the_other_flies_without_mass(flights):
    simulator = built(flights)
    simulator.start_simulation()
    flown, other = protocols_of(simulator)
    times = [pytest.approx(0.1 * number) for number in range(1, 6)]
    assert flown.telemetry == [(time, (time, 0.0, 5.0)) for time in times]
    assert [position[1] for _, position in other.telemetry] == pytest.approx([0, 1, 2, 3, 4])


def test_autopilots_are_one_update_ahead(flights):
    """A command at 0.2 s has no effect before: the vehicle has already flown up to there."""
    built(flights).start_simulation()
    assert flights.diary[:2] == ["begin", pytest.approx(0.1)]
    assert flights.diary[-1] == "close"
    assert flights.diary[1:-1] == pytest.approx([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
    assert flights.pilots[0].orders == [(0, 7, 0)]


def test_what_answers_telemetry_comes_before_the_next_flight(flights):
    class Answering(Tested):
        def handle_telemetry(self, telemetry):
            flights.diary.append(f"telemetry of {self.provider.get_id()}")

    built(flights, Answering).start_simulation()
    first = flights.diary.index("telemetry of 0")
    assert flights.diary[first - 1 : first + 3] == [
        pytest.approx(0.1),
        "telemetry of 0",
        "telemetry of 1",
        pytest.approx(0.2),
    ]


def test_an_order_that_means_nothing_is_refused(flights):
    simulator = built(flights)
    (node, _) = simulator.nodes
    handler = node.protocol_encapsulator.provider.handlers["mobility"]
    with pytest.raises(MobilityException, match=r"^node 0 .*nan"):
        handler.handle_command(GotoCoordsMobilityCommand(float("nan"), 0, 0), node)


def test_those_of_a_simulation_that_is_dropped_are_ended(flights):
    simulator = built(flights)
    simulator.run_events(3)
    del simulator
    gc.collect()
    assert flights.diary[-1] == "close"
