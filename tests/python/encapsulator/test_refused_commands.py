"""The texts; that both modes have them is asked in tests/python/conformance/test_wrong_commands.py."""

import math
from typing import Any

import pytest

from gradysim.encapsulator.refused_commands import wrong_communication, wrong_mobility, wrong_timer
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    MobilityCommand,
    SetSpeedMobilityCommand,
    SetVelocityMobilityCommand,
)


@pytest.mark.parametrize("command", [BroadcastMessageCommand("a"), SendMessageCommand("a", 2, interface=15)])
def test_nothing_is_wrong_with_a_message(command: Any) -> None:
    assert wrong_communication(command, 0, range(3)) == ""


@pytest.mark.parametrize(
    ("command", "text"),
    [
        (
            SendMessageCommand("a", 3),
            "node 1 sent a message to node 3, which does not exist: there are 3 nodes, 0 to 2",
        ),
        (SendMessageCommand("a", 1), "node 1 sent a message to itself; expected another node"),
        (SendMessageCommand("a", 1.5), "destination must be an int, the id of a node, got 1.5"),  # type: ignore[arg-type]
    ],
)
def test_a_destination_that_is_none(command: Any, text: str) -> None:
    assert wrong_communication(command, 1, range(3)) == text


@pytest.mark.parametrize("command", [GotoCoordsMobilityCommand(1, 2, 1e7), SetSpeedMobilityCommand(0)])
def test_nothing_is_wrong_with_an_order(command: Any) -> None:
    assert wrong_mobility(command, 0, can_move=True) == ""


def test_an_order_to_a_node_that_stands() -> None:
    assert wrong_mobility(SetSpeedMobilityCommand(3), 1, can_move=False).startswith(
        "node 1 is stationary, it cannot carry out SetSpeedMobilityCommand("
    )


def test_an_order_that_makes_no_sense_is_told_before_that_a_node_stands() -> None:
    text = wrong_mobility(SetSpeedMobilityCommand(math.nan), 1, can_move=False)
    assert text == "node 1 was given the speed nan: expected a finite number of m/s, >= 0"


@pytest.mark.parametrize(
    "command",
    [SetVelocityMobilityCommand(1, 2, 3), SetVelocityMobilityCommand(1, None, 3)],  # type: ignore[arg-type]
)
def test_a_velocity_is_no_speed(command: MobilityCommand) -> None:
    assert wrong_mobility(command, 1, can_move=True).startswith("node 1 was given a velocity, (1, ")


@pytest.mark.parametrize("time_s", [1, 1.5, 1e300])
def test_nothing_is_wrong_with_a_timer(time_s: float) -> None:
    assert wrong_timer("a", time_s, 0, now_s=1.0) == ""


@pytest.mark.parametrize("time_s", [0.9, math.nan, math.inf, "2", None])
def test_a_time_that_cannot_be(time_s: Any) -> None:
    assert wrong_timer("a", time_s, 1, now_s=1.0) == (
        f"cannot set timer 'a' of node 1 for {time_s!r}: expected an absolute time in seconds, not before"
        " now, 1.0 s"
    )
