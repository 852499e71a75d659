"""Integrated runs do not leak, for any number of runs in a process."""

import gc
import sys
import threading
import weakref
from collections.abc import Callable
from contextlib import suppress

import pytest
from perfect_channel import Case

from gradysim.integrated.run import IntegratedRun
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.scenario.scenario import Scenario
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.assertion import (
    AssertionHandler,
    FailedAssertionException,
    assert_always_true_for_protocol,
)
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.node import Node

RUNS = 200
CASE = Case([(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (20.0, 0.0, 0.0)], telemetry_interval_s=0.1)

alive: weakref.WeakSet[IProtocol] = weakref.WeakSet()


class Chatty(IProtocol):
    """Sends and sets timers to the end, so that both are pending at the end."""

    def __init__(self) -> None:
        alive.add(self)

    def initialize(self) -> None:
        self.provider.tracked_variables["heard"] = 0
        self.provider.schedule_timer("talk", 0.1)

    def handle_timer(self, timer: str) -> None:
        self.provider.send_communication_command(BroadcastMessageCommand("hello"))
        self.provider.schedule_timer("talk", self.provider.current_time() + 0.1)

    def handle_packet(self, message: str) -> None:
        self.provider.tracked_variables["heard"] += 1

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        self.last = telemetry

    def finish(self) -> None: ...


class Failing(Chatty):
    def handle_packet(self, message: str) -> None:
        raise LookupError("no way out")


def complete(scenario: Scenario) -> None:
    run = IntegratedRun(scenario)
    run.execute()
    assert run.result().sim_time_s == CASE.duration_s


def failed(scenario: Scenario) -> None:
    with suppress(LookupError):
        IntegratedRun(scenario).execute()


def stopped(scenario: Scenario) -> None:
    IntegratedRun(scenario).execute(should_stop=lambda: True)


def never_started(scenario: Scenario) -> None:
    IntegratedRun(scenario)


@assert_always_true_for_protocol(Chatty, "nobody hears anything")
def nobody_hears(node: Node[Chatty]) -> bool:
    return node.protocol_encapsulator.provider.tracked_variables.get("heard", 0) == 0


class Ticking(INodeHandler):
    """Has a pending event from the injection to the end."""

    @staticmethod
    def get_label() -> str:
        return "ticking"

    def inject(self, event_loop: EventLoop) -> None:
        self.event_loop = event_loop
        self.tick()

    def register_node(self, node: Node[Chatty]) -> None:
        self.node = node

    def tick(self) -> None:
        self.event_loop.schedule_event(self.event_loop.current_time + 0.1, self.tick)


def watched(scenario: Scenario) -> None:
    IntegratedRun(scenario, handlers=[Ticking(), AssertionHandler([])]).execute()


def assertion_failed(scenario: Scenario) -> None:
    with suppress(FailedAssertionException):
        IntegratedRun(scenario, handlers=[Ticking(), AssertionHandler([nobody_hears])]).execute()


def watched_but_never_started(scenario: Scenario) -> None:
    IntegratedRun(scenario, handlers=[Ticking()])


ENDS = [
    (complete, Chatty),
    (failed, Failing),
    (stopped, Chatty),
    (never_started, Chatty),
    (watched, Chatty),
    (assertion_failed, Chatty),
    (watched_but_never_started, Chatty),
]


@pytest.mark.parametrize(("make", "protocol"), ENDS)
def test_protocols_do_not_outlive_their_runs(
    make: Callable[[Scenario], None], protocol: type[IProtocol]
) -> None:
    scenario = CASE.scenario(protocol)
    for _ in range(RUNS):
        make(scenario)
    gc.collect()
    assert len(alive) == 0


@pytest.mark.parametrize(("make", "protocol"), ENDS)
def test_no_object_of_python_is_kept_for_each_run(
    make: Callable[[Scenario], None], protocol: type[IProtocol]
) -> None:
    scenario = CASE.scenario(protocol)

    def blocks_after(runs: int) -> int:
        for _ in range(runs):
            make(scenario)
        gc.collect()
        sys._clear_type_cache()  # it keeps up to 4,096 attribute names, which are a matter of chance
        return sys.getallocatedblocks()

    before = blocks_after(10)  # everything that is made once exists by then
    assert blocks_after(RUNS) - before < RUNS / 10


def test_no_thread_is_left() -> None:
    before = threading.active_count()
    for _ in range(10):
        complete(CASE.scenario(Chatty))
    assert threading.active_count() == before
