"""The first callback at which two runs part."""

from pathlib import Path

import pytest

from gradysim.ladder.difference import Difference, Event, first_difference
from python.ladder.scripted import Scripted

pytest.importorskip("gradysim._netsim")

LISTENS = """
class Other(Node):
    def handle_packet(self, message):
        self.count("heard")
"""

ANSWERS = """
class Other(Node):
    def handle_packet(self, message):
        self.send("answer", 0)
"""


def difference(folder: Path, protocols: str, works: str, fails: str, ini: str = "") -> Difference:
    """Return the first difference between the runs at two levels."""
    scripted = Scripted(folder, protocols, ini)
    found = first_difference(scripted.recording(works), scripted.recording(fails))
    assert found is not None
    return found


def names(found: Difference) -> tuple[set[str | int], set[str | int]]:
    """Return what the affected callback does in the run that works only, and in the one that fails only."""
    before, after = ({each.what for each in effects} for effects in found.effects)
    return before, after


BEACONS = """
class Base(Node):
    def initialize(self):
        self.after("beacon", 1)
    def handle_timer(self, timer):
        self.broadcast("beacon")
        self.after("beacon", 1)
"""


def test_a_message_that_is_lost(tmp_path: Path) -> None:
    found = difference(tmp_path, BEACONS + LISTENS, "ideal", "range", "*.other.mobility.initialX = 500m\n")
    assert (found.kind, found.time_s, found.node) == ("lost", 1, "other")
    assert found.event == Event("packet", "base", "timer beacon")
    assert found.outcomes == ("delivered", "below_sensitivity")


def test_a_message_that_arrives_in_the_run_that_fails_only(tmp_path: Path) -> None:
    found = difference(tmp_path, BEACONS + LISTENS, "range", "ideal", "*.other.mobility.initialX = 500m\n")
    assert (found.kind, found.outcomes) == ("gained", ("below_sensitivity", "delivered"))


def test_a_missing_message_shifts_no_others(tmp_path: Path) -> None:
    """All messages are equal. The second burst does not fill the place of what is missing of the first."""
    bursts = """
class Base(Node):
    def initialize(self):
        self.after("burst", 1)
    def handle_timer(self, timer):
        for _ in range(150):
            self.send("reading", 1)
        self.after("burst", 2)
"""
    found = difference(tmp_path, bursts + LISTENS, "airtime", "access")
    assert (found.kind, found.time_s, found.message) == ("lost", 1, (101, 150))
    assert found.outcomes == ("delivered", "queue_overflow")


def test_an_answer_after_the_timer_that_looks_for_it(tmp_path: Path) -> None:
    asks = """
class Base(Node):
    def initialize(self):
        self.has_answer = False
        self.after("ask", 1)
    def handle_timer(self, timer):
        if timer == "ask":
            self.send("question", 1)
            self.after("look", 1e-6)
        else:
            self.count("answered" if self.has_answer else "gave up")
    def handle_packet(self, message):
        self.has_answer = True
"""
    found = difference(tmp_path, asks + ANSWERS, "range", "airtime")
    assert (found.kind, found.node, found.is_later) == ("order", "base", True)
    assert found.event == Event("packet", "other", "packet", is_answer=True)
    assert found.other == Event("timer look")
    assert found.time_s == pytest.approx(1.000001, abs=1e-9)
    assert found.apart_s[0] == pytest.approx(-1e-6, abs=1e-9)
    assert 50e-6 < found.apart_s[1] < 500e-6
    assert found.affected == Event("timer look")
    assert names(found) == ({"answered"}, {"gave up"})


def test_a_timeout_that_is_canceled_too_late(tmp_path: Path) -> None:
    asks = """
class Base(Node):
    def initialize(self):
        self.after("ask", 1)
    def handle_timer(self, timer):
        self.count(timer)
        if timer == "ask":
            self.send("question", 1)
            self.after("retry-1", 50e-6)
    def handle_packet(self, message):
        self.provider.cancel_timer("retry-1")
"""
    found = difference(tmp_path, asks + ANSWERS, "range", "airtime")
    assert (found.kind, found.is_later) == ("order", True)
    assert (found.event.name, found.other) == ("packet", Event("timer retry-#"))
    assert found.time_s == pytest.approx(1.00005, abs=1e-9)
    assert found.apart_s[0] == pytest.approx(-50e-6, abs=1e-9)
    assert found.apart_s[1] > 0
    assert names(found) == (set(), {"retry-1"})


def test_callbacks_that_do_nothing_are_not_the_answer(tmp_path: Path) -> None:
    """The base hears beacons between its question and the deadline, in another order, and ignores them."""
    asks = """
class Base(Node):
    def initialize(self):
        self.waits = False
        self.after("ask", 1)
    def handle_timer(self, timer):
        self.waits = timer == "ask"
        if self.waits:
            self.send("question", 1)
            self.after("deadline", 50e-6)
    def handle_packet(self, message):
        if message == "answer" and self.waits:
            self.count("answered")

class Other(Node):
    def initialize(self):
        self.after("beacon", 1.00002)
    def handle_timer(self, timer):
        self.broadcast("beacon")
    def handle_packet(self, message):
        self.send("answer", 0)
"""
    found = difference(tmp_path, asks, "range", "airtime")
    assert (found.kind, found.other) == ("order", Event("timer deadline"))
    assert found.event.is_answer


def test_a_message_later_than_before(tmp_path: Path) -> None:
    measures = """
class Other(Node):
    def handle_packet(self, message):
        self.provider.tracked_variables["delay"] = self.provider.current_time() - 1
"""
    found = difference(tmp_path, BEACONS + measures, "range", "airtime")
    assert (found.kind, found.event.sender) == ("time", "base")
    assert 20e-6 < found.apart_s[1] < 200e-6
    assert found.time_s == pytest.approx(1 + found.apart_s[1], abs=1e-9)
    assert names(found)[1] == {"delay"}


def test_numbers_of_a_protocol_are_less_telling_than_what_it_does(tmp_path: Path) -> None:
    """The delay of the first message changes an attribute. The third one is too late for the timer."""
    measures = """
class Other(Node):
    def initialize(self):
        self.due = 3.00001
        self.provider.schedule_timer("look", self.due)
    def handle_packet(self, message):
        self.delay = self.provider.current_time() % 1
        if self.provider.current_time() > self.due - 0.5:
            self.found = True
    def handle_timer(self, timer):
        self.count("found" if vars(self).get("found") else "nothing")
"""
    found = difference(tmp_path, BEACONS + measures, "range", "airtime")
    assert (found.kind, found.other) == ("order", Event("timer look"))
    assert names(found) == ({"found"}, {"nothing"})


def test_another_position(tmp_path: Path) -> None:
    flies = """
class Base(Node):
    def initialize(self):
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(100, 0, 20))
        self.after("photo", 2)
    def handle_telemetry(self, telemetry):
        self.position = telemetry.current_position
    def handle_timer(self, timer):
        self.provider.tracked_variables["far"] = self.position[0] > 15

class Other(Node):
    pass
"""
    quadcopter = """
*.base.mobility.typename = "QuadcopterMobility"
*.base.mobility.telemetryInterval = 100ms
*.base.mobility.initialZ = 20m
"""
    found = difference(tmp_path, flies, "noise", "inertia", quadcopter)
    assert (found.kind, found.time_s, found.node) == ("position", 2, "base")
    assert found.event == Event("timer photo")
    assert found.distance_m > 1
    assert names(found) == ({"far"}, {"far"})


def test_a_position_that_telemetry_reports(tmp_path: Path) -> None:
    watches = """
class Base(Node):
    def handle_telemetry(self, telemetry):
        if telemetry.current_position[0] > 0.5:
            self.count("outside")

class Other(Node):
    pass
"""
    errors = "*.base.mobility.telemetryInterval = 100ms\n*.base.mobility.positionError = 2m\n"
    found = difference(tmp_path, watches, "noise", "position", errors)
    assert (found.kind, found.event) == ("reported position", Event("telemetry"))
    assert 0.5 < found.distance_m < 10
    assert names(found) == (set(), {"outside"})


def test_a_loss_before_what_it_changes(tmp_path: Path) -> None:
    """What the message changes is inside of an object, which the log does not see."""
    hides = """
class Heard:
    names = ()

class Other(Node):
    def initialize(self):
        self.heard = Heard()
        self.after("look", 1.5)
    def handle_packet(self, message):
        self.heard.names = (message,)
    def handle_timer(self, timer):
        self.count("found" if self.heard.names else "nothing")
"""
    found = difference(tmp_path, BEACONS + hides, "ideal", "range", "*.other.mobility.initialX = 500m\n")
    assert (found.kind, found.time_s, found.event.sender) == ("lost", 1, "base")
    assert (found.affected, found.affected_time_s) == (Event("timer look"), 1.5)
    assert names(found) == ({"found"}, {"nothing"})


def test_an_order_before_what_it_changes(tmp_path: Path) -> None:
    """What the message and the timer change are values in a dictionary, which the log does not see."""
    hides = """
class Other(Node):
    def initialize(self):
        self.seen = {"beacon": False, "in time": False}
        self.after("look", 1.00001)
    def handle_packet(self, message):
        self.seen["beacon"] = True
    def handle_timer(self, timer):
        if timer == "look":
            self.seen["in time"] = self.seen["beacon"]
            self.provider.schedule_timer("act", 1.5)
        else:
            self.count("found" if self.seen["in time"] else "nothing")
"""
    found = difference(tmp_path, BEACONS + hides, "range", "airtime")
    assert (found.kind, found.event.sender, found.other) == ("order", "base", Event("timer look"))
    assert found.is_later
    assert (found.affected, found.affected_time_s) == (Event("timer act"), 1.5)
    assert names(found) == ({"found"}, {"nothing"})


def test_runs_that_do_the_same(tmp_path: Path) -> None:
    scripted = Scripted(tmp_path, BEACONS + LISTENS)
    assert first_difference(scripted.recording("ideal"), scripted.recording("range")) is None


def test_messages_of_native_protocols_are_paired_by_their_number(tmp_path: Path) -> None:
    native = '*.base.protocol.typename = "BeaconProtocol"\n*.base.protocol.interval = 1s\n'
    found = difference(
        tmp_path, BEACONS + LISTENS, "ideal", "range", native + "*.other.mobility.initialX = 500m\n"
    )
    assert found.event.sender == "base"
