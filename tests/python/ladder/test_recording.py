"""A recorded run: which message is in which frame, and which callback it causes."""

from collections import Counter
from pathlib import Path

import pytest

from gradysim.ladder.callbacks import Cause, Effect
from gradysim.replay.tables import BROADCAST
from python.ladder.scripted import Scripted

pytest.importorskip("gradysim._netsim")

ASKS = """
class Base(Node):
    def initialize(self):
        self.after("ask", 1)
    def handle_timer(self, timer):
        self.send("question", 1)

class Other(Node):
    def handle_packet(self, message):
        self.broadcast("answer")
"""

EQUAL_MESSAGES = """
class Base(Node):
    def initialize(self):
        self.after("burst", 1)
    def handle_timer(self, timer):
        for _ in range(150):
            self.send("reading", 1)
        self.after("burst", 2)

class Other(Node):
    def handle_packet(self, message):
        self.count("heard")
"""


@pytest.mark.parametrize("level", ["ideal", "airtime", "access", "noise"])
def test_a_packet_has_the_message_that_caused_it(level: str, tmp_path: Path) -> None:
    recording = Scripted(tmp_path, ASKS).recording(level)
    named = {(each.name, each.node): place for place, each in enumerate(recording.callbacks)}
    question, answer = (recording.callbacks[named["packet", node]] for node in (1, 0))
    assert question.cause == Cause(named["timer ask", 0], 1, 0)
    assert answer.cause == Cause(named["packet", 1], BROADCAST, 0)
    assert answer.frame is not None
    assert recording.frames["node"][answer.frame] == 1


def test_messages_that_do_not_fit_into_the_queue_shift_no_others(tmp_path: Path) -> None:
    """Of each burst, 100 messages are sent: the second one does not send the rest of the first."""
    recording = Scripted(tmp_path, EQUAL_MESSAGES).recording("access")
    packets = [each for each in recording.callbacks if each.name == "packet"]
    bursts = [place for place, each in enumerate(recording.callbacks) if each.name == "timer burst"]
    assert Counter(each.cause.callback for each in packets if each.cause) == {bursts[0]: 100, bursts[1]: 100}
    assert recording.outcome(Cause(bursts[0], 1, 99), 1) == ""
    assert recording.outcome(Cause(bursts[0], 1, 100), 1) == "queue_overflow"
    assert recording.count(Cause(bursts[0], 1, 0)) == 150
    assert len(recording.dropped) == 100


def test_a_retry_belongs_to_its_message(tmp_path: Path) -> None:
    """The other node is out of range, so the frame is repeated until the limit."""
    recording = Scripted(tmp_path, ASKS, "*.other.mobility.initialX = 500m\n").recording("noise")
    message = Cause(next(p for p, each in enumerate(recording.callbacks) if each.name == "timer ask"), 1, 0)
    assert len(recording.frames_of[message]) == 7
    assert recording.outcome(message, 1) == "below_sensitivity"


def test_messages_that_find_the_channel_busy_shift_no_others(tmp_path: Path) -> None:
    """Ten nodes of IEEE 802.15.4 send more than the channel carries, so devices drop messages."""
    protocols = """
class Base(Node):
    pass

class Other(Node):
    pass

class Sensor(Node):
    def initialize(self):
        self.number = 0
        self.after("report", self.provider.random.uniform(0, 0.02))
    def handle_timer(self, timer):
        self.number += 1
        self.send(f"{self.number} of {self.provider.get_id()}", 0)
        self.after("report", self.provider.random.uniform(0.01, 0.03))
"""
    ini = """
sim-time-limit = 1s
*.radioMedium.typename = "Ieee802154NarrowbandScalarRadioMedium"
*.*.wlan[*].typename = "Ieee802154NarrowbandInterface"
*.numSensors = 10
*.sensors[*].protocol.class = "protocol.py:Sensor"
*.sensors[*].mobility.lineStepX = 1m
"""
    recording = Scripted(tmp_path, protocols, ini).recording("noise")
    packets = [each for each in recording.callbacks if each.name == "packet"]
    assert len(packets) > 50
    for each in packets:
        assert each.cause is not None
        assert f" of {recording.callbacks[each.cause.callback].node}" in each.argument
    numbers = [(each.argument, each.cause) for each in packets]
    assert len(set(numbers)) == len(numbers)
    assert "channel_access_failure" in recording.dropped.values()


def test_a_frame_in_the_air_at_the_end_is_not_lost(tmp_path: Path) -> None:
    recording = Scripted(tmp_path, ASKS, "sim-time-limit = 1.00001s\n").recording("airtime")
    message = Cause(next(p for p, each in enumerate(recording.callbacks) if each.name == "timer ask"), 1, 0)
    assert len(recording.frames_of[message]) == 1
    assert recording.outcome(message, 1) == ""


def test_a_run_that_fails_has_its_callbacks_up_to_then(tmp_path: Path) -> None:
    fails = ASKS.replace('self.broadcast("answer")', "raise ValueError(message)")
    recording = Scripted(tmp_path, fails).recording("noise")
    assert recording.callbacks[-1].name == "packet"
    assert recording.callbacks[-1].effects == [Effect("raise", "ValueError", "question")]
    assert recording.replay.end is not None
    assert not recording.replay.end["complete"]
