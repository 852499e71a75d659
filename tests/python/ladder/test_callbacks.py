"""The log of what callbacks do, and what caused them."""

import contextlib
from collections.abc import Callable
from pathlib import Path

import pytest

import gradysim
from gradysim.ladder.callbacks import Callback, CallbackLog, Cause, Effect, without_numbers
from gradysim.scenario import load_scenarios
from python.quiet_protocol import QUIET

pytest.importorskip("gradysim._netsim")

INI = """[General]
sim-time-limit = 2.5s
*.node.protocol.class = "protocol.py:Node"
*.node.mobility.telemetryInterval = 500ms
**.mobility.typename = "StationaryMobility"
"""


@pytest.fixture
def log_of(tmp_path: Path) -> Callable[[str], CallbackLog]:
    """`log_of(body)`: the log of a node whose class has this body. A run may fail."""

    def log(body: str) -> CallbackLog:
        imports = "from gradysim.protocol.plugin.dispatcher import DispatchReturn, create_dispatcher\n"
        (tmp_path / "protocol.py").write_text(f"{QUIET}\n{imports}\nclass Node(Quiet):\n{body}", "utf-8")
        (tmp_path / "test.ini").write_text(INI, "utf-8")
        (scenario,) = load_scenarios(tmp_path / "test.ini")
        found = CallbackLog()
        run = gradysim.start(scenario)
        found.watch(run, scenario)
        with contextlib.suppress(RuntimeError):
            run.run_until()
        return found

    return log


def of_name(log: CallbackLog, name: str) -> list[Callback]:
    return [each for each in log.callbacks if each.name == name]


def test_a_timer_has_the_callback_that_set_it(log_of: Callable[[str], CallbackLog]) -> None:
    log = log_of("""
    def initialize(self):
        self.provider.schedule_timer("late", 2.0)
        self.provider.schedule_timer("late", 1.0)
    def handle_timer(self, timer):
        if self.provider.current_time() == 1:
            self.provider.schedule_timer("next-17", 1.5)
""")
    early, late = of_name(log, "timer late")
    assert (early.time_ns, late.time_ns) == (1_000_000_000, 2_000_000_000)
    assert (early.cause, late.cause) == (Cause(0, "timer late", 1), Cause(0, "timer late", 0))
    (following,) = of_name(log, "timer next-17")
    assert following.cause == Cause(log.callbacks.index(early), "timer next-#", 0)


def test_a_canceled_timer_has_its_time_and_what_canceled_it(log_of: Callable[[str], CallbackLog]) -> None:
    log = log_of("""
    def initialize(self):
        self.provider.schedule_timer("answer", 1.0)
        self.provider.schedule_timer("timeout", 2.0)
    def handle_timer(self, timer):
        self.provider.cancel_timer("timeout")
""")
    assert log.canceled == {Cause(0, "timer timeout", 0): (1, 2_000_000_000)}
    assert of_name(log, "timer timeout") == []


def test_changes_of_variables_and_attributes_are_effects(log_of: Callable[[str], CallbackLog]) -> None:
    log = log_of("""
    def initialize(self):
        self.waits = True
        self.heard = []
        self.provider.schedule_timer("x", 1.0)
    def handle_timer(self, timer):
        self.provider.tracked_variables["count"] = 5
        self.waits = False
        self.heard.append("x")
""")
    (timer,) = of_name(log, "timer x")
    assert timer.effects == [
        Effect("set", "count", 5),
        Effect("attribute", "waits", False),
        Effect("attribute", "heard", ("list", 1)),
    ]


def test_telemetry_without_effects_is_left_out(log_of: Callable[[str], CallbackLog]) -> None:
    log = log_of("""
    def handle_telemetry(self, telemetry):
        if self.provider.current_time() == 1.5:
            self.provider.tracked_variables["seen"] = True
""")
    (seen,) = of_name(log, "telemetry")
    assert (seen.time_ns, seen.number) == (1_500_000_000, 2)


def test_a_failed_message_is_a_callback(log_of: Callable[[str], CallbackLog]) -> None:
    log = log_of("""
    def initialize(self):
        self.provider.schedule_timer("send", 1.0)
    def handle_timer(self, timer):
        from gradysim.protocol.messages.communication import BroadcastMessageCommand
        for number in range(102):
            self.provider.send_communication_command(BroadcastMessageCommand(str(number)))
    def handle_failed_message(self, message, destination, reason):
        self.provider.tracked_variables["failed"] = message
""")
    failed = of_name(log, "failed_message")
    assert [each.argument for each in failed] == ["100", "101"]
    assert [each.effects for each in failed] == [[Effect("set", "failed", each)] for each in ("100", "101")]


def test_what_a_plugin_does_counts_once(log_of: Callable[[str], CallbackLog]) -> None:
    """The dispatcher replaces the method of the instance, and here the protocol's own is not called."""
    log = log_of("""
    def initialize(self):
        create_dispatcher(self).register_handle_timer(self.before)
        self.provider.schedule_timer("x", 1.0)
    def before(self, protocol, timer):
        self.provider.tracked_variables["handled"] = True
        return DispatchReturn.INTERRUPT
""")
    (timer,) = of_name(log, "timer x")
    assert timer.effects == [Effect("set", "handled", True)]


def test_a_method_that_calls_another_one_is_one_callback(log_of: Callable[[str], CallbackLog]) -> None:
    log = log_of("""
    def initialize(self):
        self.handle_timer("now")
    def handle_timer(self, timer):
        self.provider.tracked_variables["timer"] = timer
""")
    (only,) = log.callbacks
    assert (only.name, only.effects) == ("initialize", [Effect("set", "timer", "now")])


def test_an_exception_is_an_effect(log_of: Callable[[str], CallbackLog]) -> None:
    log = log_of("""
    def initialize(self):
        self.provider.schedule_timer("x", 1.0)
    def handle_timer(self, timer):
        raise RuntimeError("broken")
""")
    assert log.callbacks[-1].effects == [Effect("raise", "RuntimeError", "broken")]


@pytest.mark.parametrize(
    ("text", "expected"),
    [("retry-17", "retry-#"), ("at 1.25e-05 s", "at # s"), ("2nd of 3", "#nd of #"), ("beacon", "beacon")],
)
def test_names_that_differ_in_numbers_count_as_one(text: str, expected: str) -> None:
    assert without_numbers(text) == expected


@pytest.mark.parametrize(
    ("one", "other", "is_alike"),
    [
        (Effect("set", "count", 3), Effect("set", "count", 4), True),
        (Effect("set", "state", "idle"), Effect("set", "state", "busy"), False),
        (Effect("attribute", "waits", True), Effect("attribute", "waits", False), False),
        (Effect("send", 1, "photo 3"), Effect("send", 1, "photo 4"), True),
        (Effect("send", 1, "photo 3"), Effect("send", 2, "photo 3"), False),
        (Effect("timer", "retry-1", None), Effect("timer", "retry-2", None), True),
    ],
)
def test_effects_that_differ_in_numbers_are_alike(one: Effect, other: Effect, is_alike: bool) -> None:
    assert (one.alike == other.alike) == is_alike
