"""An invalid call raises the same exception with the same message in both modes."""

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
    MobilityCommandType,
    SetSpeedMobilityCommand,
    SetVelocityMobilityCommand,
)
from gradysim.protocol.plugin.mission_mobility import MissionMobilityPlugin, MissionMobilityPluginException
from gradysim.scenario.errors import Source
from gradysim.scenario.schema.values import Setting
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

TABLE: list[tuple[Deed, type[Exception], list[str]]] = [  # action, exception, required parts of the message
    (send("hello"), SEND, ["'hello'", "CommunicationCommand"]),
    (send(None), SEND, ["None", "CommunicationCommand"]),
    (send(GotoCoordsMobilityCommand(1, 2, 3)), SEND, ["GOTO_COORDS", "a CommunicationCommand"]),
    (send(BroadcastMessageCommand), SEND, ["class .*BroadcastMessageCommand", "a CommunicationCommand"]),
    (send(BroadcastMessageCommand(cast("str", 5))), SEND, ["got 5", "str"]),
    (send(BroadcastMessageCommand(cast("str", b"x"))), SEND, ["got b'x'", "str"]),
    (send(SendMessageCommand("a", 7)), SEND, ["7", NODES]),
    (send(SendMessageCommand("a", -1)), SEND, ["-1", NODES]),
    (send(SendMessageCommand("a", "1")), SEND, ["no node is called '1'"]),
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
    (steer(SetVelocityMobilityCommand(5, 0, 0)), STEER, [r"a velocity, \(5, 0, 0\)"]),
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
    """Return the exception that node 0 gets."""

    class Wrongdoer(Quiet):
        def initialize(self) -> None:
            if self.provider.get_id() == 0:
                self.provider.schedule_timer("now", 0.25)

        def handle_timer(self, timer: str) -> None:
            deed(self.provider)

    with pytest.raises(Exception) as raised:  # noqa: PT011 (the tests check its type)
        CASE.run(mode, Wrongdoer)
    return raised.value


@cache
def refusal(mode: str, number: int) -> Exception:
    """Return the exception that node 0 gets for the action in that row of the table."""
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
def test_a_stationary_node_refuses_mobility_commands(mode: str) -> None:
    class Ordered(Quiet):
        def initialize(self) -> None:
            self.provider.send_mobility_command(SetSpeedMobilityCommand(5))

    scenario = CASE.scenario(Ordered)
    stands = {"typename": Setting("StationaryMobility", Source(Path("a.ini"), 1, "key"))}
    nodes = tuple(replace(node, mobility=stands) for node in scenario.nodes)
    with pytest.raises(MasslessMobilityException) as raised:
        MODES[mode](replace(scenario, nodes=nodes))
    assert repr(SetSpeedMobilityCommand(5)) in str(raised.value)


ARGUMENTS: dict[str, Callable[[Any], object]] = {
    "schedule_timer": lambda provider: provider.schedule_timer("a"),
    "cancel_timer": lambda provider: provider.cancel_timer(),
    "current_time": lambda provider: provider.current_time(5),
    "get_id": lambda provider: provider.get_id(5),
    "send_communication_command": lambda provider: provider.send_communication_command(),
    "send_mobility_command": lambda provider: provider.send_mobility_command(),
}


@pytest.mark.parametrize("name", ARGUMENTS)
@pytest.mark.parametrize("mode", MODES)
def test_wrong_arguments_are_a_type_error_that_names_the_method(mode: str, name: str) -> None:
    failure = failure_of(mode, ARGUMENTS[name])
    assert type(failure) is TypeError
    assert f"{name}()" in str(failure)
    assert failure.__notes__ == ["in handle_timer of node 0 (Wrongdoer 0) at 0.25 s of simulated time"]


@pytest.mark.parametrize("mode", MODES)
def test_set_speed_with_zeros_sets_a_speed(mode: str) -> None:
    class Flies(Quiet):
        def initialize(self) -> None:
            set_speed = MobilityCommandType.SET_SPEED
            self.provider.send_mobility_command(MobilityCommand(set_speed, 5, 0, 0))
            self.provider.send_mobility_command(MobilityCommand(set_speed, 2, 0, 0, 0, 0, 0))
            self.provider.send_mobility_command(GotoCoordsMobilityCommand(100, 0, 0))

    result = Case([(0.0, 0.0, 0.0)], duration_s=2.0).run(mode, Flies)
    assert result.nodes[0].position == pytest.approx((4, 0, 0), abs=0.05)


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
