"""Messages that fail, and queues that block: integrated mode tells the sender; prototype mode never does."""

import statistics
from pathlib import Path
from typing import Any

import pytest
from perfect_channel import MODES

from gradysim.integrated.run import IntegratedRun
from gradysim.protocol.errors import CommunicationException
from gradysim.replay import read_replay
from gradysim.replay.sink import ReplayWriter

FAILING = """
class Tested(Quiet):
    def initialize(self):
        self.provider.tracked_variables["log"] = []
        if self.provider.get_id() == 0:
            self.provider.schedule_timer("send", 1)
    def note(self, *entry):
        self.provider.tracked_variables["log"].append((self.provider.current_time(), *entry))
    def handle_timer(self, timer):
        for number in range(4):
            self.provider.send_communication_command(BroadcastMessageCommand(str(number)))
    def handle_failed_message(self, message, destination, reason):
        self.note(message, destination, reason)
"""
ONE_BY_ONE = "**.mac.dcf.channelAccess.pendingQueue.packetCapacity = 1"


def log_of(result: Any, node: int = 0) -> list[Any]:
    log: list[Any] = result.nodes[node].tracked_variables["log"]
    return log


def test_a_message_that_a_full_queue_drops_is_reported(make_scenario: Any) -> None:
    result = MODES["integrated"](make_scenario(FAILING, ONE_BY_ONE))
    assert log_of(result) == [(1, str(number), None, "queue_overflow") for number in (1, 2, 3)]
    assert result.outcomes["messages"]["broadcast"]["queue_overflow"] == 3


UNICAST = """
class Tested(Tested):
    def handle_timer(self, timer):
        self.provider.send_communication_command(SendMessageCommand("lost", 1))
"""


@pytest.mark.parametrize(
    ("settings", "reason"),
    [
        (("*.uavs[1].mobility.initialX = 100km",), "retry_limit"),
        (
            ('**.wlan[*].typename = "Ieee802154NarrowbandInterface"', "*.uavs[1].mobility.initialX = 100km"),
            "retry_limit",
        ),
        (
            (
                '*.radioMedium.typename = "UnitDiskRadioMedium"',
                "**.communicationRange = 50m",
                "*.uavs[1].mobility.initialX = 100km",
            ),
            "out_of_range",
        ),
    ],
)
def test_a_unicast_without_an_acknowledgement_is_reported(
    make_scenario: Any, settings: tuple[str, ...], reason: str
) -> None:
    result = MODES["integrated"](make_scenario(FAILING + UNICAST, *settings))
    ((time_s, *entry),) = log_of(result)
    assert entry == ["lost", 1, reason]
    assert time_s >= 1


def test_prototype_mode_never_reports(make_scenario: Any) -> None:
    result = MODES["prototype"](make_scenario(FAILING + UNICAST, "*.uavs[1].mobility.initialX = 100km"))
    assert log_of(result) == []


def test_a_report_waits_for_the_computer(make_scenario: Any) -> None:
    settings = (
        ONE_BY_ONE,
        "*.uavs[0].computer.processingTime = 1ms",
        "*.uavs[*].mobility.telemetryInterval = 0s",
    )
    log = log_of(MODES["integrated"](make_scenario(FAILING, *settings)))
    assert [time_s for time_s, *_ in log] == [1.002, 1.003, 1.004]


def test_an_endless_repetition_within_one_instant_is_an_error(make_scenario: Any) -> None:
    again = """
class Tested(Tested):
    def handle_failed_message(self, message, destination, reason):
        self.provider.send_communication_command(BroadcastMessageCommand(message))
"""
    with pytest.raises(CommunicationException, match=r"time .*still"):
        MODES["integrated"](make_scenario(FAILING + again, ONE_BY_ONE))


def test_a_class_without_it_runs_as_before(make_scenario: Any) -> None:
    without = FAILING.replace("def handle_failed_message", "def other")
    settings = (ONE_BY_ONE,)
    one, other = (MODES["integrated"](make_scenario(text, *settings)) for text in (FAILING, without))
    assert one.fingerprint == other.fingerprint
    assert log_of(other) == []


SATURATED = """
class Tested(Quiet):
    def initialize(self):
        self.provider.tracked_variables["log"] = []
        if self.provider.get_id() == 0:
            self.number = 0
            self.provider.schedule_timer("setpoint", 0.1)
            self.provider.schedule_timer("flood", 0.1)
    def handle_timer(self, timer):
        now = self.provider.current_time()
        if timer == "setpoint":
            self.send(f"{self.number}")
            self.number += 1
            self.provider.schedule_timer("setpoint", now + 0.1)
        else:
            self.send("x" * 1000)
            self.provider.schedule_timer("flood", now + 0.0005)
    def send(self, text):
        self.provider.send_communication_command(SendMessageCommand(text, 1))
    def handle_packet(self, message):
        if len(message) < 1000:
            self.provider.tracked_variables["log"].append((self.provider.current_time(), int(message)))
"""
SLOW = ("sim-time-limit = 15s", "**.wlan[*].bitrate = 6Mbps", "*.uavs[*].mobility.telemetryInterval = 0s")


def test_a_queue_that_blocks_drops_nothing(make_scenario: Any) -> None:
    """Setpoints every 0.1 s beside 16 Mbps of other messages on a channel of 6 Mbps."""
    dropping, blocking = (
        MODES["integrated"](make_scenario(SATURATED, *SLOW, f'**.pendingQueue.whenFull = "{what}"'))
        for what in ("drop", "block")
    )
    outcomes = [result.outcomes["messages"]["unicast"] for result in (dropping, blocking)]
    assert outcomes[0]["queue_overflow"] > 1000
    assert outcomes[1]["queue_overflow"] == 0
    assert outcomes[1]["queued"] <= 102  # the queue, one in progress, and one in front of the queue
    numbers = [[number for _, number in log_of(result, 1)] for result in (dropping, blocking)]
    assert len(numbers[0]) < 0.5 * 150
    assert numbers[1] == list(range(len(numbers[1])))  # none is lost, but they are late
    assert len(numbers[1]) > 100
    delays_s = [time_s - 0.1 * (number + 1) for time_s, number in log_of(blocking, 1)]
    assert statistics.median(delays_s) > 0.1


EVENTS = """
class Tested(Quiet):
    def initialize(self):
        self.provider.tracked_variables["log"] = []
        if self.provider.get_id() == 0:
            self.provider.schedule_timer("send", 1)
            self.provider.schedule_timer("later", 1)
    def handle_timer(self, timer):
        self.provider.tracked_variables["log"].append((self.provider.current_time(), timer))
        if timer == "send":
            for number in range(4):
                self.provider.send_communication_command(BroadcastMessageCommand("x" * 1000))
"""


@pytest.mark.parametrize(
    "settings",
    [
        ('**.pendingQueue.whenFull = "block"', "**.pendingQueue.packetCapacity = 1"),
        (
            '**.wlan[*].typename = "Ieee802154NarrowbandInterface"',
            '**.wlan[*].queue.whenFull = "block"',
            "**.wlan[*].queue.packetCapacity = 1",
        ),
        (
            '**.pendingQueue.whenFull = "block"',
            "**.pendingQueue.packetCapacity = 1",
            '*.radioMedium.timing = "channelAccess"',
        ),
    ],
)
def test_events_wait_until_the_message_has_entered(make_scenario: Any, settings: tuple[str, ...]) -> None:
    text = EVENTS.replace("1000", "50") if "802154" in settings[0] else EVENTS
    quiet = "*.uavs[*].mobility.telemetryInterval = 0s"
    result = MODES["integrated"](make_scenario(text, quiet, *settings))
    (first_s, first), (second_s, second) = log_of(result)
    assert (first, second) == ("send", "later")
    assert (first_s, second_s) == (1, pytest.approx(1.001, abs=0.02))
    assert second_s > 1.0001  # two frames were on the air meanwhile
    assert result.outcomes["messages"]["broadcast"] == {"sent": 4} | {
        outcome: 0 for outcome in result.outcomes["messages"]["broadcast"] if outcome != "sent"
    }


def test_a_replay_of_a_blocked_run(make_scenario: Any, tmp_path: Path) -> None:
    settings = ('**.pendingQueue.whenFull = "block"', "**.pendingQueue.packetCapacity = 1")
    recorded = IntegratedRun(make_scenario(EVENTS, *settings), replay=ReplayWriter(tmp_path / "run.html"))
    recorded.execute()
    events = read_replay(tmp_path / "run.html").table("events")
    assert list(events["text"])[:2] == ["send", "later"]
    assert events["time_ns"][1] > events["time_ns"][0] == 1_000_000_000
