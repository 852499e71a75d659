"""Skipped updates change only the number of events."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand, SetSpeedMobilityCommand
from gradysim.simulator.handler.communication import CommunicationHandler, CommunicationMedium
from gradysim.simulator.handler.mobility import MasslessMobilityConfiguration, MasslessMobilityHandler
from gradysim.simulator.handler.mobility.massless import IdleSkippingMobilityHandler
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration


def ran(kind, plans, *, telemetry_s=0, duration=10, rate=0.01, delay=0):
    """Run a node for each plan, {time: command}; return the number of events, and the callbacks."""
    diary = []

    class Planned(IProtocol):
        def note(self, what):
            identifier = self.provider.get_id()
            position = simulator.get_node(identifier).position
            diary.append((self.provider.current_time(), identifier, what, position))

        def initialize(self):
            self.plan = plans[self.provider.get_id()]
            for time in self.plan:
                self.provider.schedule_timer(repr(time), time)

        def handle_timer(self, timer):
            self.note(timer)
            if timer == "again":
                return
            order = self.plan[float(timer)]
            if isinstance(order, float):
                self.provider.schedule_timer("again", self.provider.current_time() + order)
            elif isinstance(order, str):
                self.provider.send_communication_command(BroadcastMessageCommand(order))
            elif order is not None:
                self.provider.send_mobility_command(order)

        def handle_packet(self, message):
            self.note(message)
            if message == "go":
                self.provider.send_mobility_command(GotoCoordsMobilityCommand(0, 0, 1))

        def handle_telemetry(self, telemetry):
            self.note(telemetry.current_position)

        def finish(self):
            self.note("finish")

    handler = kind(MasslessMobilityConfiguration(update_rate=rate))
    medium = CommunicationHandler(CommunicationMedium(transmission_range=60, delay=delay))
    builder = SimulationBuilder(SimulationConfiguration(duration=duration, seed=1, execution_logging=False))
    builder.add_handler(TimerHandler()).add_handler(medium).add_handler(handler)
    for number in range(len(plans)):
        interval = telemetry_s[number] if isinstance(telemetry_s, list) else telemetry_s
        handler.configure_node(builder.add_node(Planned, (10 * number, 0, 0)), telemetry_interval=interval)
    simulator = builder.build()
    simulator.start_simulation()
    return simulator.iteration, diary


def both(plans, **world):
    """Return the number of events at rest, after checking that all else is equal."""
    as_ever = ran(MasslessMobilityHandler, plans, **world)
    resting = ran(IdleSkippingMobilityHandler, plans, **world)
    assert resting[1] == as_ever[1]
    assert resting[0] <= as_ever[0]
    return resting[0]


def test_where_nothing_happens_there_are_no_updates():
    """Except one every 2^20 updates, so that the caller of the simulation gets a turn."""
    assert both([{}, {}], duration=100) == 1
    assert ran(IdleSkippingMobilityHandler, [{}], duration=100_000)[0] == 1 + 9


@pytest.mark.parametrize("time", [5.0, 5.003])
def test_there_is_one_update_before_a_timer_and_one_after_it(time):
    assert both([{time: None}]) == 1 + 3


def test_timers_of_one_instant_share_these_two():
    assert both([{5.0: None}] * 4) == 4 + 3


def test_there_is_one_update_for_each_telemetry_and_one_after_it():
    assert both([{}, {}], telemetry_s=1, duration=10.5) == 1 + 10 * (2 + 2)


def test_there_are_updates_while_one_flies():
    flight = [{5.0: GotoCoordsMobilityCommand(10, 0, 0)}, {}]
    assert both(flight) == 1 + 1 + 1 + 102


def test_the_first_step_is_made_when_it_would_be_made():
    """A command at the time of an update takes effect at once, since the timer was set first."""
    assert both([{5.0: GotoCoordsMobilityCommand(1, 0, 0), 5.01: None, 5.015: None}]) < 50


def test_a_timer_set_after_the_update_of_its_time_comes_after_it():
    assert both([{4.995: 0.005, 4.99: 0.01, 4.98: GotoCoordsMobilityCommand(1, 0, 0)}]) < 50


orders = st.one_of(
    st.none(),
    st.sampled_from([0.0, 0.01, 0.02, 0.005, 1.0]),
    st.sampled_from(["hello", "go"]),
    st.builds(GotoCoordsMobilityCommand, st.integers(0, 3), st.integers(0, 3), st.just(0)),
    st.builds(SetSpeedMobilityCommand, st.sampled_from([0, 1, 10, 1000])),
)
times = st.one_of(st.integers(0, 500).map(lambda number: number / 100), st.floats(0, 5))
intervals = st.sampled_from([0, 0, 0.03, 0.075, 1.0, 1.3])


@given(
    st.lists(st.tuples(st.dictionaries(times, orders, max_size=5), intervals), min_size=1, max_size=3),
    st.sampled_from([0.01, 0.02, 0.03, 0.007]),
    st.sampled_from([0, 0.01, 0.3]),
)
def test_whatever_happens_it_happens_as_ever(nodes, rate, delay):
    plans, telemetry_s = map(list, zip(*nodes, strict=True))
    both(plans, telemetry_s=telemetry_s, duration=6, rate=rate, delay=delay)
