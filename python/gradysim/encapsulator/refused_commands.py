"""Why a command of a protocol cannot be carried out, in the same words in both modes.

The handlers of prototype mode ask, and the engine by its bindings, about a command that it has refused. A
text is "" where nothing is wrong with the command itself.
"""

from collections.abc import Collection
from enum import Enum
from typing import Any

from gradysim.encapsulator.command_numbers import finite_number, is_in_scene, three_numbers
from gradysim.protocol.errors import CommunicationException
from gradysim.protocol.messages.communication import CommunicationCommandType
from gradysim.protocol.messages.destination_id import checked_destination
from gradysim.protocol.messages.interface_index import checked_interface
from gradysim.protocol.messages.mobility import MobilityCommandType
from gradysim.protocol.position import LARGEST_COORDINATE_M
from gradysim.protocol.readable_number import readable_number


def wrong_communication(command: object, node_id: int, ids: Collection[int]) -> str:
    """Return what is wrong with a message that a node was to send; `ids` are those of all nodes."""
    if not hasattr(command, "message") or not hasattr(command, "command_type"):
        return f"node {node_id} can send a CommunicationCommand, got {command!r}"
    message, kind = command.message, command.command_type
    if not isinstance(message, str):
        return f"node {node_id} can send text only, such as json.dumps makes, got {message!r}"
    if not _is_one_of(CommunicationCommandType, kind):
        expected = _listed(CommunicationCommandType)
        return f"node {node_id} gave an unknown communication command: {kind!r}; expected {expected}"
    try:
        checked_interface(getattr(command, "interface", 0))  # commands of one's own may have none
        if kind == CommunicationCommandType.SEND:
            return _wrong_destination(getattr(command, "destination", None), node_id, ids)
    except CommunicationException as wrong:
        return str(wrong)
    return ""


def wrong_mobility(command: object, node_id: int, can_move: bool) -> str:
    """Return what is wrong with an order to the vehicle of a node; geographic places are for `geo_target`."""
    if not hasattr(command, "command_type") or not hasattr(command, "param_1"):
        return f"node {node_id} can carry out a MobilityCommand, was given {command!r}"
    kind = command.command_type
    if not _is_one_of(MobilityCommandType, kind):
        expected = _listed(MobilityCommandType)
        wrong = f"node {node_id} was given an unknown mobility command: {kind!r}; expected {expected}"
    elif kind == MobilityCommandType.SET_SPEED:
        wrong = _wrong_speed(command, node_id)
    else:
        wrong = _wrong_point(command, node_id)
    if wrong or can_move:
        return wrong
    return (
        f"node {node_id} is stationary, it cannot carry out {command!r}; expected a mobility.typename that"
        " can move"
    )


def wrong_timer(name: object, timestamp: float, node_id: int, now_s: float) -> str:
    """Return what is wrong with a timer that a node was to set."""
    if wrong := wrong_timer_name(name):
        return wrong
    time_s = finite_number(timestamp)
    if time_s is not None and time_s >= now_s:
        return ""
    return (
        f"cannot set timer {name!r} of node {node_id} for {timestamp!r}: expected an absolute "
        f"time in seconds, not before now, {readable_number(now_s)} s"
    )


def wrong_timer_name(name: object) -> str:
    """Return what is wrong with the name of a timer."""
    return "" if isinstance(name, str) else f"the name of a timer must be a str, got {name!r}"


def _wrong_destination(destination: object, node_id: int, ids: Collection[int]) -> str:
    if destination is None:
        return f"node {node_id} sent a message to one node without a destination; expected the id of a node"
    number = destination if isinstance(destination, int) else checked_destination(destination)
    if number == node_id:
        return f"node {node_id} sent a message to itself; expected another node"
    if number in ids:
        return ""
    return (
        f"node {node_id} sent a message to node {destination!r}, which does not exist: "
        f"there are {len(ids)} nodes, {min(ids)} to {max(ids)}"
    )


def _wrong_point(command: Any, node_id: int) -> str:
    point = three_numbers(command)
    if point is not None and is_in_scene(point):
        return ""
    return (
        f"node {node_id} was sent to ({command.param_1!r}, {command.param_2!r}, {command.param_3!r}): "
        f"expected three finite numbers of metres, each from -{LARGEST_COORDINATE_M} to"
        f" {LARGEST_COORDINATE_M}"
    )


def _wrong_speed(command: Any, node_id: int) -> str:
    if command.param_2 is not None or command.param_3 is not None:
        return (
            f"node {node_id} was given a velocity, ({command.param_1!r}, {command.param_2!r}, "
            f"{command.param_3!r}): a massless vehicle takes a speed and a target"
        )
    speed_mps = finite_number(command.param_1)
    if speed_mps is not None and speed_mps >= 0:
        return ""
    return f"node {node_id} was given the speed {command.param_1!r}: expected a finite number of m/s, >= 0"


def _is_one_of(kinds: type[Enum], kind: object) -> bool:
    """Whether it is the number of a kind: 1.0, which equals one, is none."""
    return isinstance(kind, int) and kind in {known.value for known in kinds}


def _listed(kinds: type[Enum]) -> str:
    *names, last = (f"{kind.name} ({kind.value})" for kind in kinds)
    return f"{', '.join(names)} or {last}"
