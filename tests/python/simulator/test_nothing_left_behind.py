"""Many simulations in one process: each frees its resources at its end, for all kinds of ends."""

import gc
import logging
import threading
import tracemalloc

import pytest

from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.plugin.mission_mobility import MissionMobilityPlugin
from gradysim.simulator.handler.assertion import AssertionHandler, assert_always_true_for_protocol
from gradysim.simulator.handler.communication import CommunicationHandler
from gradysim.simulator.handler.mobility import MobilityConfiguration, MobilityHandler
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.handler.visualization import VisualizationConfiguration, VisualizationHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from python.quiet_protocol import Quiet


class Busy(Quiet):
    """Uses several features; `failing` makes it fail at its third timer."""

    failing = False

    def initialize(self):
        self.timers = 0
        self.mission = MissionMobilityPlugin(self)
        self.mission.start_mission([(0, 0, 10), (10, 0, 10)])
        self.provider.schedule_timer("tick", 0.1)

    def handle_timer(self, timer):
        self.timers += 1
        if self.failing and self.timers == 3:
            raise RuntimeError("failed deliberate")
        self.provider.tracked_variables["timers"] = self.timers
        self.provider.send_communication_command(BroadcastMessageCommand("tick"))
        self.provider.schedule_timer("tick", self.provider.current_time() + 0.1)


class Failing(Busy):
    failing = True


@assert_always_true_for_protocol(Busy, "few timers")
def few_timers(node):
    return node.protocol_encapsulator.protocol.timers < 1000


def build(protocol=Busy, handlers=()):
    builder = SimulationBuilder(SimulationConfiguration(duration=0.5, execution_logging=False))
    mobility = MobilityHandler(MobilityConfiguration(update_rate=0.1))
    for handler in (
        TimerHandler(),
        CommunicationHandler(),
        mobility,
        AssertionHandler([few_timers]),
        *handlers,
    ):
        builder.add_handler(handler)
    for number in range(3):
        builder.add_node(protocol, (number, 0, 0))
    return builder.build()


def run_to_the_end():
    build().start_simulation()


def fail():
    with pytest.raises(RuntimeError, match="deliberate"):
        build(Failing).start_simulation()


def stop_early():
    simulator = build()
    for _ in range(10):
        simulator.step_simulation()
    simulator.finalize()


def drop_half_way():
    simulator = build()
    for _ in range(10):
        simulator.step_simulation()


def never_begin():
    build()


def protocols_alive():
    gc.collect()
    return sum(isinstance(thing, Busy) for thing in gc.get_objects())


@pytest.fixture(autouse=True)
def _as_it_was():
    root = logging.getLogger()
    before = (list(root.handlers), list(root.filters), root.level, threading.active_count())
    yield
    gc.collect()
    assert (list(root.handlers), list(root.filters), root.level, threading.active_count()) == before


@pytest.mark.parametrize("use", [run_to_the_end, fail, stop_early, drop_half_way, never_begin])
def test_no_protocol_stays(use):
    before = protocols_alive()
    use()
    assert protocols_alive() == before


@pytest.mark.verify
def test_a_thousand_simulations_leave_no_memory_behind():
    """The first hundred fill caches. Each of the others may add less than 50 bytes."""
    uses = [run_to_the_end, fail, stop_early, drop_half_way, never_begin]

    def use_many(count):
        for number in range(count):
            uses[number % len(uses)]()
        gc.collect()
        return tracemalloc.get_traced_memory()[0]

    tracemalloc.start()
    try:
        growth = -use_many(100) + use_many(900)
    finally:
        tracemalloc.stop()
    assert growth < 900 * 50


def test_simulations_that_are_shown_leave_no_thread():
    for _ in range(20):
        handler = VisualizationHandler(VisualizationConfiguration(host="127.0.0.1", port=0))
        build(handlers=[handler]).start_simulation()
    assert [thread.name for thread in threading.enumerate() if "visualization" in thread.name] == []


def test_a_failing_simulation_that_is_shown_leaves_no_thread():
    handler = VisualizationHandler(VisualizationConfiguration(host="127.0.0.1", port=0))
    with pytest.raises(RuntimeError, match="deliberate"):
        build(Failing, handlers=[handler]).start_simulation()
    assert [thread.name for thread in threading.enumerate() if "visualization" in thread.name] == []
