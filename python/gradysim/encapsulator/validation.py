"""Validation of what a protocol asks of its provider, with the same error text in both modes.

The handlers of prototype mode call these functions first. The compiled engine calls them, through
cpp/proxy_protocol/node_commands.cpp, when it cannot carry out a call. A function `wrong_...` returns "" if
the call itself is valid.

Commands are recognized by their attributes. So dataclasses of other packages with the same fields, such as
those of `gradys_embedded.protocol`, are valid, too.
"""

import math
from collections.abc import Collection, Mapping
from difflib import get_close_matches
from enum import Enum
from functools import cache
from typing import Any

from gradysim.protocol.defaults import MOST_INTERFACES
from gradysim.protocol.errors import CommunicationException, MasslessMobilityException
from gradysim.protocol.messages.communication import CommunicationCommandType, SendMessageCommand
from gradysim.protocol.messages.mobility import MobilityCommandType, SetVelocityMobilityCommand
from gradysim.protocol.plain_value import readable_number
from gradysim.protocol.position import LARGEST_COORDINATE_M, Position, geo_to_cartesian

_LARGEST_ID = 2**31 - 1
_FAR_M = 100e3
"""Farther than nodes usually fly."""
_NEAR_RATIO = 1 / 20
"""Exchanged coordinates are reported if they are nearer by this factor. Near the diagonal, where latitude and
longitude are about equal, both positions may be intended."""


# Messages


def wrong_communication(command: object, node_id: int, ids: Collection[int]) -> str:
    """Return what is wrong with a communication command of a node; `ids` are those of all nodes."""
    if not hasattr(command, "message") or not hasattr(command, "command_type"):
        return f"node {node_id} can send a CommunicationCommand, got {command!r}"
    message, kind = command.message, command.command_type
    if not isinstance(message, str):
        return f"node {node_id} can send a str only, such as json.dumps returns, got {message!r}"
    if not _is_member(CommunicationCommandType, kind):
        expected = _listed(CommunicationCommandType)
        return f"node {node_id}: unknown communication command {kind!r}; expected {expected}"
    try:
        checked_interface(getattr(command, "interface", 0))  # a user's own command may not have one
        if kind == CommunicationCommandType.SEND:
            return _wrong_destination(getattr(command, "destination", None), node_id, ids)
    except CommunicationException as wrong:
        return str(wrong)
    return ""


def checked_interface(interface: object) -> int:
    """Return the index of a network interface. CommunicationException if no node can have it.

    Whether this node has it is for the engine to check. Prototype mode has no interfaces.
    """
    if isinstance(interface, int) and not isinstance(interface, bool) and 0 <= interface < MOST_INTERFACES:
        return interface
    raise CommunicationException(
        f"interface must be an int from 0 to {MOST_INTERFACES - 1}, such as 1 for wlan[1], got {interface!r}"
    )


def checked_destination(destination: object) -> int:
    """Return the id of a node, also if it is an equal number such as `1.0` or an integer of NumPy.

    Raise CommunicationException if it equals no id.
    """
    try:
        hash(destination)  # prototype mode looks it up in a dictionary
        number = int(destination)  # type: ignore[call-overload]
    except (TypeError, ValueError, OverflowError):
        number = -1
    if number == destination and 0 <= number <= _LARGEST_ID:
        return int(number)
    raise CommunicationException(f"destination must be an int, the id of a node, got {destination!r}")


class _UnknownName:
    """Message for a name that no node has. Only reading it looks for the nearest one, which is slow."""

    def __init__(self, name: str, ids_by_name: Mapping[str, int]) -> None:
        self._name = name
        self._ids_by_name = ids_by_name

    def __str__(self) -> str:
        expected = f"expected one such as {next(iter(self._ids_by_name))!r}"
        if similar := get_close_matches(self._name, self._ids_by_name, n=1):
            expected = f"did you mean {similar[0]!r}?"
        return f"no node is called {self._name!r}; {expected}"

    def __repr__(self) -> str:
        return repr(str(self))

    def __reduce__(self) -> tuple[type[str], tuple[str]]:
        return str, (str(self),)


def id_of_name(name: str, ids_by_name: Mapping[str, int]) -> int:
    """Return the id of a node. CommunicationException, with the nearest name, if no node is called so."""
    if not isinstance(name, str):
        raise CommunicationException(f"the name of a node must be a str, got {name!r}")
    if name in ids_by_name:
        return ids_by_name[name]
    if not ids_by_name:
        raise CommunicationException(f"no node is called {name!r}: the nodes have no names; expected an id")
    raise CommunicationException(_UnknownName(name, ids_by_name))


def addressed_by_id(command: Any, ids_by_name: Mapping[str, int]) -> Any:
    """Return a command to the id of its destination if it has a name. CommunicationException as `id_of_name`.

    Invalid commands are returned as they are, for `wrong_communication`.
    """
    name, kind = getattr(command, "destination", None), getattr(command, "command_type", None)
    if not isinstance(name, str) or kind != CommunicationCommandType.SEND:
        return command
    destination = id_of_name(name, ids_by_name)
    return SendMessageCommand(command.message, destination, interface=getattr(command, "interface", 0))


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


# Timers


def wrong_timer(name: object, timestamp: float, node_id: int, now_s: float) -> str:
    """Return what is wrong with a timer that a node sets."""
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


# Mobility


def wrong_mobility(command: object, node_id: int, can_move: bool) -> str:
    """Return what is wrong with a mobility command of a node.

    A geographic target goes through `geo_target` first.
    """
    if not hasattr(command, "command_type") or not hasattr(command, "param_1"):
        return f"node {node_id} can carry out a MobilityCommand, got {command!r}"
    kind = command.command_type
    if not _is_member(MobilityCommandType, kind):
        expected = _listed(MobilityCommandType)
        wrong = f"node {node_id}: unknown mobility command {kind!r}; expected {expected}"
    elif kind == MobilityCommandType.SET_SPEED:
        wrong = _wrong_speed(command, node_id)
    else:
        wrong = _wrong_point(command, node_id)
    if wrong or can_move:
        return wrong
    return (
        f"node {node_id} does not follow commands, got {command!r}; expected a mobility.typename that does,"
        ' such as "MasslessMobility"'
    )


def is_speed(command: Any) -> bool:
    """Return whether a SET_SPEED command sets a speed. Otherwise it sets a velocity of three components.

    Unused parameters are None, or 0 as in gradysim 0.7. A `SetVelocityMobilityCommand` always sets a
    velocity.
    """
    if type(command).__name__ == SetVelocityMobilityCommand.__name__:
        return False
    return all(value is None or finite_number(value) == 0 for value in (command.param_2, command.param_3))


def three_numbers(command: Any) -> Position | None:
    """Return the first three parameters of a mobility command as floats; None if one is not finite."""
    x, y, z = map(finite_number, (command.param_1, command.param_2, command.param_3))
    return None if x is None or y is None or z is None else (x, y, z)


def finite_number(value: float | None) -> float | None:
    """Return `value` as a float; None if it is not a finite number."""
    try:
        return float(value) if value is not None and math.isfinite(value) else None
    except (TypeError, ValueError, OverflowError):
        return None


def geo_target(command: Any, node_id: int, reference_coordinates: Position) -> Position:
    """Return the target of a GOTO_GEO_COORDS command of a node as (x, y, z) in meters.

    The origin is (latitude deg, longitude deg, altitude m). Raise MasslessMobilityException if a parameter is
    not a finite number, the latitude is out of range, the target is too far away, or latitude and longitude
    are exchanged.
    """
    coordinates = three_numbers(command)
    if coordinates is None:
        raise MasslessMobilityException(f"{_geographic(command, node_id)}: expected three finite numbers")
    latitude, longitude, altitude = coordinates
    if not -90 <= latitude <= 90:
        raise MasslessMobilityException(
            f"{_geographic(command, node_id)}: expected a latitude from -90 to 90 degrees"
        )
    target = geo_to_cartesian(reference_coordinates, coordinates)
    far_away = f", which is {math.hypot(*target) / 1000:.0f} km from the origin of the scene"
    if not _is_in_scene(target):
        raise MasslessMobilityException(
            f"{_geographic(command, node_id)}{far_away}; expected at most {LARGEST_COORDINATE_M} m on each"
            " axis"
        )
    distance_m = math.hypot(*target[:2])
    if distance_m > _FAR_M and -90 <= longitude <= 90:
        exchanged = geo_to_cartesian(reference_coordinates, (longitude, latitude, altitude))
        if math.hypot(*exchanged[:2]) <= min(_FAR_M, distance_m * _NEAR_RATIO):
            raise MasslessMobilityException(
                f"{_geographic(command, node_id)}{far_away}; expected latitude before longitude: did you"
                f" mean latitude {longitude!r}, longitude {latitude!r}?"
            )
    return target


def _wrong_point(command: Any, node_id: int) -> str:
    point = three_numbers(command)
    if point is not None and _is_in_scene(point):
        return ""
    return (
        f"node {node_id} was sent to {_parameters(command)}: expected three finite numbers of meters, each"
        f" from -{LARGEST_COORDINATE_M} to {LARGEST_COORDINATE_M}"
    )


def _wrong_speed(command: Any, node_id: int) -> str:
    if not is_speed(command):
        return (
            f"node {node_id} got a velocity, {_parameters(command)}: a massless vehicle takes a speed and a"
            " target"
        )
    speed_mps = finite_number(command.param_1)
    if speed_mps is not None and speed_mps >= 0:
        return ""
    return f"node {node_id} got the speed {command.param_1!r}: expected a finite number of m/s, >= 0"


def _is_in_scene(point: Position) -> bool:
    return all(abs(coordinate) <= LARGEST_COORDINATE_M for coordinate in point)


def _geographic(command: Any, node_id: int) -> str:
    return (
        f"node {node_id} was sent to latitude {command.param_1!r}, longitude {command.param_2!r}, "
        f"altitude {command.param_3!r}"
    )


def _parameters(command: Any) -> str:
    return f"({command.param_1!r}, {command.param_2!r}, {command.param_3!r})"


def _is_member(kinds: type[Enum], kind: object) -> bool:
    """Return whether `kind` is the number of a member. It must be an int: 1.0 is not a member."""
    return isinstance(kind, int) and kind in _values_of(kinds)


@cache
def _values_of(kinds: type[Enum]) -> frozenset[object]:
    return frozenset(known.value for known in kinds)


def _listed(kinds: type[Enum]) -> str:
    *names, last = (f"{kind.name} ({kind.value})" for kind in kinds)
    return f"{', '.join(names)} or {last}"
