"""What cannot be carried out is the same exception in both modes, with the same text."""

import math
import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest
from perfect_channel import MODES, Case

from gradysim.protocol.errors import CommunicationException, MasslessMobilityException, TimerException
from gradysim.protocol.interface import IProvider
from gradysim.protocol.messages.communication import (
    BroadcastMessageCommand,
    CommunicationCommand,
    CommunicationCommandType,
    SendMessageCommand,
)
from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    GotoGeoCoordsMobilityCommand,
    MobilityCommand,
    SetSpeedMobilityCommand,
    SetVelocityMobilityCommand,
)
from gradysim.protocol.plugin.mission_mobility import MissionMobilityPlugin, MissionMobilityPluginException
from gradysim.scenario.errors.source import Source
from gradysim.scenario.settings import Setting
from python.quiet_protocol import Quiet

CASE = Case([(0.0, 0.0, 0.0), (10.0, 0.0, 0.0)])
Deed = Callable[[IProvider], None]
Wrong = Any


def send(command: Wrong) -> Deed:
    return lambda provider: provider.send_communication_command(command)


def steer(command: Wrong) -> Deed:
    return lambda provider: provider.send_mobility_command(command)


def timer(name: Wrong, time: Wrong) -> Deed:
    return lambda provider: provider.schedule_timer(name, time)


def cancel(name: Wrong) -> Deed:
    return lambda provider: provider.cancel_timer(name)


NODES = "0 to 1"
ID = "int, the id of a node"
NO_INTERFACE = r"^interface must be an int from 0 to 15, such as 1 for wlan\[1\], got "
AT_LEAST_0 = ">= 0"
KIND = CommunicationCommandType.SEND
SEND, STEER, TIMER = CommunicationException, MasslessMobilityException, TimerException

TABLE: list[tuple[Deed, type[Exception], list[str]]] = [  # deed, exception, what its text has to name
    (send("hello"), SEND, ["'hello'", "CommunicationCommand"]),
    (send(None), SEND, ["None", "CommunicationCommand"]),
    (send(GotoCoordsMobilityCommand(1, 2, 3)), SEND, ["GOTO_COORDS", "a CommunicationCommand"]),
    (send(BroadcastMessageCommand), SEND, ["class .*BroadcastMessageCommand", "a CommunicationCommand"]),
    (send(BroadcastMessageCommand(cast("str", 5))), SEND, ["got 5", "text"]),
    (send(BroadcastMessageCommand(cast("str", b"x"))), SEND, ["got b'x'", "text"]),
    (send(SendMessageCommand("a", 7)), SEND, ["7", NODES]),
    (send(SendMessageCommand("a", -1)), SEND, ["-1", NODES]),
    (send(SendMessageCommand("a", cast("int", "1"))), SEND, ["'1'", ID]),
    (send(SendMessageCommand("a", cast("int", 1.5))), SEND, ["1.5", ID]),
    (send(SendMessageCommand("a", 2**32 + 1)), SEND, [str(2**32 + 1), NODES]),
    (send(SendMessageCommand("a", 2**70)), SEND, [str(2**70), NODES]),
    (send(SendMessageCommand("a", cast("int", [1]))), SEND, [r"\[1\]", ID]),
    (send(SendMessageCommand("a", 0)), SEND, ["itself", "another node"]),
    (send(CommunicationCommand(KIND, "a")), SEND, ["destination", "the id of a node"]),
    (send(SimpleNamespace(command_type=KIND, message="a")), SEND, ["destination", "the id of a node"]),
    (send(CommunicationCommand(cast("Any", 9), "a")), SEND, ["9", r"SEND \(0\) or BROADCAST \(1\)"]),
    (send(SendMessageCommand("a", 1, interface=99)), SEND, [NO_INTERFACE + "99$"]),
    (send(BroadcastMessageCommand("a", interface=-1)), SEND, [NO_INTERFACE + "-1$"]),
    (send(BroadcastMessageCommand("a", interface=2**70)), SEND, [NO_INTERFACE + f"{2**70}$"]),
    (send(BroadcastMessageCommand("a", interface=True)), SEND, [NO_INTERFACE + "True$"]),
    (send(BroadcastMessageCommand("a", interface=cast("int", "two"))), SEND, [NO_INTERFACE + "'two'$"]),
    (send(BroadcastMessageCommand("a", interface=cast("int", None))), SEND, [NO_INTERFACE + "None$"]),
    (steer("north"), STEER, ["'north'", "MobilityCommand"]),
    (steer(BroadcastMessageCommand("a")), STEER, ["message='a'", "a MobilityCommand"]),
    (steer(None), STEER, ["None", "a MobilityCommand"]),
    (steer(GotoCoordsMobilityCommand(math.nan, 0, 0)), STEER, ["nan", "three"]),
    (steer(GotoCoordsMobilityCommand(0, math.inf, 0)), STEER, ["inf", "three"]),
    (steer(GotoCoordsMobilityCommand(0, 0, cast("float", "5"))), STEER, ["'5'", "number"]),
    (steer(GotoCoordsMobilityCommand(10**400, 0, 0)), STEER, ["1000", "number"]),
    (steer(MobilityCommand(cast("Any", 1), 1, 2)), STEER, ["None", "number"]),
    (
        steer(GotoCoordsMobilityCommand(0, 0, -1e8)),
        STEER,
        ["-100000000.0", "-10000000 to 10000000"],
    ),
    (steer(GotoGeoCoordsMobilityCommand(0, 160, 0)), STEER, ["160", "at most 10000000 m"]),
    (steer(GotoGeoCoordsMobilityCommand(91, 0, 0)), STEER, ["91", "-90 to 90"]),
    (steer(GotoGeoCoordsMobilityCommand(0, math.nan, 0)), STEER, ["nan", "three"]),
    (steer(GotoGeoCoordsMobilityCommand(0, 10**400, 0)), STEER, ["1000", "number"]),
    (steer(SetSpeedMobilityCommand(10**400)), STEER, ["1000", "number"]),
    (steer(SetSpeedMobilityCommand(-1)), STEER, ["-1", AT_LEAST_0]),
    (steer(SetSpeedMobilityCommand(math.nan)), STEER, ["nan", AT_LEAST_0]),
    (steer(SetSpeedMobilityCommand(cast("float", "5"))), STEER, ["'5'", "number"]),
    (steer(SetVelocityMobilityCommand(1, 2, 3)), STEER, [r"a velocity, \(1, 2, 3\)", "a speed and a target"]),
    (steer(MobilityCommand(cast("Any", 9), 1)), STEER, ["9", r"GOTO_COORDS \(1\), .* or SET_SPEED \(3\)"]),
    (timer("a", -1), TIMER, ["-1", "not before now, 0.25 s"]),
    (timer("a", math.nan), TIMER, ["timer 'a'", "nan", "seconds"]),
    (timer("a", math.inf), TIMER, ["timer 'a'", "inf", "seconds"]),
    (timer("a", 10**400), TIMER, ["1000", "seconds"]),
    (timer("a", "5"), TIMER, ["'5'", "seconds"]),
    (timer("a", None), TIMER, ["None", "seconds"]),
    (timer(5, 1), TIMER, ["got 5", "str"]),
    (cancel(5), TIMER, ["got 5", "str"]),
]


def failure_of(mode: str, deed: Deed) -> Exception:
    """What node 0 gets for it."""

    class Wrongdoer(Quiet):
        def initialize(self) -> None:
            if self.provider.get_id() == 0:
                self.provider.schedule_timer("now", 0.25)

        def handle_timer(self, timer: str) -> None:
            deed(self.provider)

    with pytest.raises(Exception) as raised:  # noqa: PT011 (which one is what the tests ask)
        CASE.run(mode, Wrongdoer)
    return raised.value


@cache
def refusal(mode: str, number: int) -> Exception:
    """What node 0 gets for the deed in that row of the table."""
    return failure_of(mode, TABLE[number][0])


@pytest.mark.parametrize("number", range(len(TABLE)))
def test_both_modes_say_the_same(number: int) -> None:
    one, other = (str(refusal(mode, number)) for mode in MODES)
    assert one == other


@pytest.mark.parametrize("number", range(len(TABLE)))
@pytest.mark.parametrize("mode", MODES)
def test_it_is_refused_with_the_value_and_what_was_expected(mode: str, number: int) -> None:
    _, kind, words = TABLE[number]
    failure = refusal(mode, number)
    assert type(failure) is kind, repr(failure)
    assert [word for word in words if not re.search(word, str(failure))] == [], str(failure)
    assert failure.__notes__ == ["in handle_timer of node 0 (Wrongdoer 0) at 0.25 s of simulated time"]


@pytest.mark.parametrize("mode", MODES)
def test_a_node_that_stands_refuses_all_orders(mode: str) -> None:
    class Ordered(Quiet):
        def initialize(self) -> None:
            self.provider.send_mobility_command(SetSpeedMobilityCommand(5))

    scenario = CASE.scenario(Ordered)
    stands = {"typename": Setting("StationaryMobility", Source(Path("a.ini"), 1, "key"))}
    nodes = tuple(replace(node, mobility=stands) for node in scenario.nodes)
    with pytest.raises(MasslessMobilityException) as raised:
        MODES[mode](replace(scenario, nodes=nodes))
    assert str(raised.value) == (
        f"node 0 is stationary, it cannot carry out {SetSpeedMobilityCommand(5)!r};"
        " expected a mobility.typename that can move"
    )


ARGUMENTS: list[tuple[Callable[[Any], object], str, str]] = [  # call, its method, what is wrong
    (lambda provider: provider.schedule_timer("a"), "schedule_timer", "'timestamp'"),
    (lambda provider: provider.schedule_timer("a", 1, 2), "schedule_timer", "positional"),
    (lambda provider: provider.schedule_timer("a", timer="b"), "schedule_timer", "multiple values .*'timer'"),
    (lambda provider: provider.cancel_timer(), "cancel_timer", "missing .*'timer'"),
    (lambda provider: provider.current_time(5), "current_time", "positional"),
    (lambda provider: provider.get_id(5), "get_id", "positional"),
    (lambda provider: provider.send_communication_command(), "send_communication_command", "'command'"),
    (lambda provider: provider.send_mobility_command(), "send_mobility_command", "missing .*'command'"),
]


@pytest.mark.parametrize("row", ARGUMENTS, ids=[f"{name} {wrong}" for _, name, wrong in ARGUMENTS])
@pytest.mark.parametrize("mode", MODES)
def test_wrong_arguments_are_told_in_one_line(mode: str, row: tuple[Deed, str, str]) -> None:
    deed, name, wrong = row
    failure = failure_of(mode, deed)
    assert type(failure) is TypeError
    assert re.search(rf"{name}\(.*{wrong}", str(failure))
    assert "\n" not in str(failure)
    assert failure.__notes__ == ["in handle_timer of node 0 (Wrongdoer 0) at 0.25 s of simulated time"]


MISSIONS = {
    "1,2,3\n4,5\n": r"line 2|:2",
    "1,2,3\n4,5,x\n": r"line 2|:2",
    "1,2,3\n\n4,5,nan\n": r"line 3|:3",
    "": "waypoint",
}


@pytest.mark.parametrize("text", MISSIONS)
@pytest.mark.parametrize("mode", MODES)
def test_a_malformed_mission_file_is_refused_with_the_line(mode: str, text: str, tmp_path: Path) -> None:
    file = tmp_path / "mission.txt"
    file.write_text(text)

    class OnMission(Quiet):
        def initialize(self) -> None:
            MissionMobilityPlugin(self).start_mission_with_waypoint_file(str(file))

    with pytest.raises(MissionMobilityPluginException, match=MISSIONS[text]) as raised:
        CASE.run(mode, OnMission)
    assert "mission.txt" in str(raised.value)


@pytest.mark.parametrize(
    ("case", "words"),
    [
        (Case([(math.nan, 0.0, 0.0)]), "nan"),
        (Case([(0.0, 0.0, 0.0)], range_m=-1.0), "-1"),
        (Case([(0.0, 0.0, 0.0)], speed_mps=-1.0), "-1"),
        (Case([(0.0, 0.0, 0.0)], telemetry_interval_s=-1.0), "-1"),
    ],
    ids=["position", "range", "speed", "telemetry interval"],
)
@pytest.mark.parametrize("mode", MODES)
def test_a_scenario_that_makes_no_sense_is_refused(mode: str, case: Case, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        case.run(mode, Quiet)
