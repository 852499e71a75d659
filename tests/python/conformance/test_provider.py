"""Callbacks and queries of a protocol are the same in both modes."""

from collections.abc import Iterator
from fractions import Fraction
from itertools import count
from typing import Any, ClassVar

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from perfect_channel import MODES, Case

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.protocol.messages.telemetry import Telemetry
from python.quiet_protocol import Quiet

LINE = [(10.0 * node, 0.0, 0.0) for node in range(4)]
CALLBACKS = ["__init__", "initialize", "handle_timer", "handle_packet", "handle_telemetry", "finish"]


class Failing(Quiet):
    """Node 1 fails in one of its callbacks. The other nodes do nothing there."""

    failing: ClassVar[str]
    made: ClassVar[Iterator[int]]

    def __init__(self) -> None:
        if next(self.made) == 1:
            self.fail_in("__init__")

    def initialize(self) -> None:
        self.provider.schedule_timer("talk", 0.125)
        self.call("initialize")

    def handle_timer(self, timer: str) -> None:
        self.call("handle_timer")
        self.provider.send_communication_command(BroadcastMessageCommand("hello"))

    def handle_packet(self, message: str) -> None:
        self.call("handle_packet")

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        self.call("handle_telemetry")

    def finish(self) -> None:
        self.call("finish")

    def call(self, callback: str) -> None:
        if self.provider.get_id() == 1:
            self.fail_in(callback)

    def fail_in(self, callback: str) -> None:
        if callback == self.failing:
            raise LookupError(f"no way out of {callback}")


class Dice(Quiet):
    def initialize(self) -> None:
        self.provider.tracked_variables["seen"] = []
        self.provider.schedule_timer("roll", 0.5)
        self.roll()

    def handle_timer(self, timer: str) -> None:
        self.roll()

    def finish(self) -> None:
        self.roll()

    def roll(self) -> None:
        self.provider.tracked_variables["seen"] += [self.provider.random.getrandbits(64)]


class Variables(Quiet):
    """Sets, overwrites, removes and replaces tracked variables."""

    def initialize(self) -> None:
        tracked = self.provider.tracked_variables
        tracked["id"] = self.provider.get_id()
        tracked["text"] = "über"
        tracked["gone"] = [1, 2]
        tracked["nested"] = {"a": (1.5, None, True)}
        self.provider.schedule_timer("later", 0.25)

    def handle_timer(self, timer: str) -> None:
        del self.provider.tracked_variables["gone"]
        self.provider.tracked_variables.update(text=timer, time=self.provider.current_time())

    def finish(self) -> None:
        if self.provider.get_id() == 2:
            self.provider.tracked_variables = {"replaced": True}


def tracked(mode: str, protocol: type[IProtocol], case: Case | None = None) -> list[dict[str, Any]]:
    result = (case or Case(LINE)).run(mode, protocol)
    return [dict(node.tracked_variables) for node in result.nodes]


@pytest.mark.parametrize("mode", MODES)
def test_ids_count_from_0(mode: str) -> None:
    assert [node["id"] for node in tracked(mode, Variables) if "id" in node] == [0, 1, 3]


def test_the_same_variables_are_tracked() -> None:
    assert tracked("integrated", Variables) == tracked("prototype", Variables)


@pytest.mark.parametrize("seed", [0, 1, 2**63 - 1])
def test_the_same_random_numbers_are_drawn(seed: int) -> None:
    case = Case(LINE, seed=seed)
    assert tracked("integrated", Dice, case) == tracked("prototype", Dice, case)


@pytest.mark.parametrize("mode", MODES)
def test_each_node_draws_its_own(mode: str) -> None:
    numbers = [number for node in tracked(mode, Dice) for number in node["seen"]]
    assert len(set(numbers)) == 3 * len(LINE)


def failure(mode: str, callback: str) -> tuple[str, list[str]]:
    protocol = type("Failing", (Failing,), {"failing": callback, "made": count()})
    with pytest.raises(LookupError) as caught:
        Case(LINE, telemetry_interval_s=0.25).run(mode, protocol)
    return str(caught.value), caught.value.__notes__


@pytest.mark.parametrize("callback", CALLBACKS)
def test_a_failure_carries_the_same_note(callback: str) -> None:
    assert failure("integrated", callback) == failure("prototype", callback)


@settings(max_examples=200)
@given(st.lists(st.floats(0, 1), max_size=20, unique_by=lambda time: round(time * 1e12)))
def test_timers_of_any_times_are_due_within_the_picosecond_that_the_engine_counts_in(
    times: list[float],
) -> None:
    def due(mode: str) -> list[tuple[str, float]]:
        log: list[tuple[str, float]] = []

        class Alarm(Quiet):
            def initialize(self) -> None:
                for number, time in enumerate(times):
                    self.provider.schedule_timer(str(number), time)

            def handle_timer(self, timer: str) -> None:
                log.append((timer, self.provider.current_time()))

        Case([(0.0, 0.0, 0.0)]).run(mode, Alarm)
        return log

    integrated, prototype = due("integrated"), due("prototype")
    assert [timer for timer, _ in integrated] == [timer for timer, _ in prototype]
    assert [time for _, time in integrated] == pytest.approx(
        [time for _, time in prototype], rel=0, abs=5.01e-13
    )


class ToWhatEqualsOne(Quiet):
    """Node 0 sends to node 1, with several spellings of its id."""

    destinations: ClassVar[list[Any]] = [1, True, 1.0, np.int64(1), np.int16(1), np.float64(1), Fraction(1)]
    heard: ClassVar[list[int]]

    def initialize(self) -> None:
        if self.provider.get_id() == 0:
            for number in range(len(self.destinations)):
                self.provider.schedule_timer(str(number), 0.1 * number)

    def handle_timer(self, timer: str) -> None:
        command = SendMessageCommand(timer, self.destinations[int(timer)])
        self.provider.send_communication_command(command)

    def handle_packet(self, message: str) -> None:
        assert self.provider.get_id() == 1
        self.heard.append(int(message))


@pytest.mark.parametrize("mode", MODES)
def test_a_destination_is_whatever_equals_an_id(mode: str) -> None:
    ToWhatEqualsOne.heard = []
    Case(LINE).run(mode, ToWhatEqualsOne)
    assert ToWhatEqualsOne.heard == list(range(len(ToWhatEqualsOne.destinations)))
