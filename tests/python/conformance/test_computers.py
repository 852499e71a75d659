"""Computers that take time: events of protocols wait in order, in both modes alike."""

import math
import statistics
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from perfect_channel import MODES, Case
from scripted import Script, play
from test_scripted_networks import networks, scripts, seeds

from gradysim.integrated.run import IntegratedRun
from gradysim.prototype.run import PrototypeRun
from gradysim.replay import read_replay
from gradysim.replay.sink import ReplayWriter
from gradysim.results.result import RunResult

LOG = """
class Logged(Quiet):
    def initialize(self):
        self.provider.tracked_variables["log"] = []
    def note(self, *entry):
        self.provider.tracked_variables["log"].append((self.provider.current_time(), *entry))
    def handle_timer(self, timer):
        self.note(timer)
    def handle_packet(self, message):
        self.note(message)
"""
MILLISECOND = "*.uavs[0].computer.processingTime = 1ms"

Run = Callable[..., RunResult]


@pytest.fixture(params=MODES)
def run(request: pytest.FixtureRequest, make_scenario: Any) -> Run:
    return lambda python, *settings: MODES[request.param](make_scenario(LOG + python, *settings))


def log_of(result: RunResult, node: int = 0) -> list[Any]:
    log: list[Any] = result.nodes[node].tracked_variables["log"]
    return log


@given(
    networks, seeds, scripts(st.integers(1, 30)), st.sampled_from([1e-4, 3e-3]), st.sampled_from([0, 0.3, 2])
)
def test_the_same_callbacks_at_the_same_times(
    positions: Any, seed: int, script: Script, time_s: float, spread: float
) -> None:
    case = Case(positions, seed=seed, processing_time_s=time_s, processing_time_spread=spread)
    assert play("integrated", case, script) == play("prototype", case, script)


@given(networks, seeds, scripts(st.integers(1, 30)))
def test_the_same_telemetry(positions: Any, seed: int, script: Script) -> None:
    case = Case(
        positions, seed=seed, telemetry_interval_s=0.01, processing_time_s=0.004, processing_time_spread=1
    )
    assert play("integrated", case, script) == play("prototype", case, script)


BURST = """
class Tested(Logged):
    def initialize(self):
        super().initialize()
        for name in "abc":
            self.provider.schedule_timer(name, 1)
        self.provider.schedule_timer("late", 2)
"""


def test_events_wait_in_order(run: Run) -> None:
    result = run(BURST, MILLISECOND)
    assert log_of(result) == [(1.001, "a"), (1.002, "b"), (1.003, "c"), (2.001, "late")]
    assert log_of(result, 1) == [(1, "a"), (1, "b"), (1, "c"), (2, "late")]


CANCELS = """
class Tested(Logged):
    def initialize(self):
        super().initialize()
        for name in ("a", "b", "b", "c", "b"):
            self.provider.schedule_timer(name, 1)
    def handle_timer(self, timer):
        super().handle_timer(timer)
        self.provider.cancel_timer("b")
        self.provider.schedule_timer("later", 1.5)
        self.provider.cancel_timer("later")
"""


def test_a_timer_that_is_canceled_while_it_waits_takes_no_time(run: Run) -> None:
    assert log_of(run(CANCELS, MILLISECOND)) == [(1.001, "a"), (1.002, "c")]


TELEMETRY = """
class Tested(Logged):
    def initialize(self):
        super().initialize()
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(1000, 0, 0))
    def handle_telemetry(self, telemetry):
        self.note(telemetry.current_position[0])
"""


def test_of_telemetry_only_the_latest_waits(run: Run) -> None:
    """Telemetry of 0.1 s is processed until 0.33 s. That of 0.2 s gives way to that of 0.3 s, and so on."""
    settings = ("*.uavs[0].mobility.telemetryInterval = 0.1s", "*.uavs[0].mobility.speed = 10mps")
    log = log_of(run(TELEMETRY, "*.uavs[0].computer.processingTime = 0.23s", *settings))
    assert [time_s for time_s, _ in log] == pytest.approx([0.33 + 0.23 * number for number in range(8)])
    assert [x for _, x in log] == pytest.approx([1, 3, 5, 7, 10, 12, 14, 17])


def test_what_waits_at_the_end_is_not_handled(run: Run) -> None:
    result = run(BURST, MILLISECOND, "sim-time-limit = 1.0025s")
    assert [name for _, name in log_of(result)] == ["a", "b"]


@pytest.mark.parametrize("mode", MODES)
def test_times_are_log_normal(mode: str, make_scenario: Any) -> None:
    ticks = """
class Tested(Logged):
    def initialize(self):
        super().initialize()
        self.tick(1)
    def tick(self, number):
        self.provider.schedule_timer(str(number), number)
    def handle_timer(self, timer):
        super().handle_timer(timer)
        self.tick(int(timer) + 1)
"""
    settings = (
        "*.uavs[*].computer.processingTime = 0.4ms",
        "*.uavs[*].computer.processingTimeSpread = 1.5",
        "*.uavs[*].mobility.telemetryInterval = 0s",
        "sim-time-limit = 3000s",
    )
    result = MODES[mode](make_scenario(LOG + ticks, *settings))
    logs = [[math.log(time_s - int(tick)) for time_s, tick in log_of(result, node)] for node in (0, 1)]
    for of_node in logs:
        assert len(of_node) > 2900
        assert statistics.fmean(of_node) == pytest.approx(math.log(0.4e-3), abs=0.1)
        assert statistics.stdev(of_node) == pytest.approx(1.5, abs=0.08)
    assert abs(statistics.correlation(logs[0][:2900], logs[1][:2900])) < 0.06


DRAWS = """
class Tested(Logged):
    def initialize(self):
        super().initialize()
        self.provider.schedule_timer("draw", 1)
    def handle_timer(self, timer):
        self.note(self.provider.random.random())
"""


def test_other_random_numbers_stay(run: Run) -> None:
    ((without_s, without),) = log_of(run(DRAWS))
    ((time_s, drawn),) = log_of(run(DRAWS, MILLISECOND, "*.uavs[0].computer.processingTimeSpread = 1"))
    assert (without_s, without) == (1, drawn)
    assert time_s > 1


PING = """
class Tested(Logged):
    def initialize(self):
        super().initialize()
        if self.provider.get_id() == 1:
            for number in range(20):
                self.provider.schedule_timer("send", 0.5 + 0.05 * number)
    def handle_timer(self, timer):
        self.provider.send_communication_command(BroadcastMessageCommand(repr(self.provider.current_time())))
    def handle_packet(self, message):
        self.note(self.provider.current_time() - float(message))
"""


def test_delays_of_messages_are_those_that_protocols_measure(run: Run) -> None:
    spread = "*.uavs[0].computer.processingTimeSpread = 1"
    result = run(PING, "*.uavs[0].computer.processingTime = 30ms", spread)
    measured = [delay_s for _, delay_s in log_of(result)]
    delays = result.message_delays["broadcast"]
    assert delays.count == len(measured) > 10
    assert delays.mean_s == pytest.approx(statistics.fmean(measured), abs=1e-6)
    assert (delays.min_s, delays.max_s) == pytest.approx((min(measured), max(measured)), abs=1e-6)


@pytest.mark.parametrize("run_class", [IntegratedRun, PrototypeRun])
def test_a_replay_has_events_when_they_are_handled(run_class: Any, make_scenario: Any, tmp_path: Any) -> None:
    replay = ReplayWriter(tmp_path / "run.html")
    run_class(make_scenario(LOG + BURST, MILLISECOND), replay=replay).execute()
    events = read_replay(tmp_path / "run.html").table("events")
    times_ns = [time for time, node in zip(events["time_ns"], events["node"], strict=True) if node == 0]
    assert times_ns == [1_001_000_000, 1_002_000_000, 1_003_000_000, 2_001_000_000]


def test_native_protocols_take_as_long(make_scenario: Any) -> None:
    native = (
        '*.uavs[0].protocol.typename = "BeaconProtocol"',
        '*.uavs[1].protocol.typename = "SinkProtocol"',
        "*.uavs[*].mobility.telemetryInterval = 0s",
    )
    settings = ("*.uavs[1].computer.processingTime = 5ms", *native)
    without, delayed = (
        MODES["integrated"](make_scenario("", *lines)).message_delays["broadcast"]
        for lines in (native, settings)
    )
    assert delayed.mean_s - without.mean_s == pytest.approx(5e-3, abs=1e-6)
