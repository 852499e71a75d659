"""Vehicles without mass: they fly straight to their target at their speed, and stop there."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, cast

from gradysim.encapsulator.validation import geo_target, three_numbers, wrong_mobility
from gradysim.motion.gauss_markov import GaussMarkov
from gradysim.motion.position_error import POSITION_ERROR_RATIO, POSITION_ERROR_TIME_S, position_error
from gradysim.protocol.checked_values import checked_number
from gradysim.protocol.defaults import SPEED_MPS, UPDATE_S
from gradysim.protocol.errors import MasslessMobilityException as MasslessMobilityException
from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    MobilityCommand,
    MobilityCommandType,
)
from gradysim.protocol.position import Position
from gradysim.simulator.event import EventLoop, time_after
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.handler.mobility.updates import TelemetryGroup, UpdateTimes
from gradysim.simulator.log import context_of
from gradysim.simulator.node import Node
from gradysim.simulator.validation import check_reference, checked_configuration


@dataclass
class MasslessMobilityConfiguration:
    """Motion of all nodes. `MasslessMobilityHandler.configure_node` changes it for one node.

    Attributes:
        update_rate: Time between two updates of all positions; s, > 0.
        default_speed: m/s, >= 0.
        reference_coordinates: (latitude deg, longitude deg, altitude m) of the origin of the frame.
    """

    update_rate: float = UPDATE_S
    default_speed: float = SPEED_MPS
    reference_coordinates: Position = (0, 0, 0)

    def __post_init__(self) -> None:
        checked_number("update_rate", self.update_rate, 0, above=True, unit="s")
        checked_number("default_speed", self.default_speed, 0, unit="m/s")
        check_reference(self.reference_coordinates)


@dataclass
class _NodeSettings:
    speed_mps: float | None = None
    telemetry_interval_s: float | None = None
    refuses_commands: bool = False
    position_error_m: float = 0.0
    position_error_time_s: float = POSITION_ERROR_TIME_S
    position_error_ratio: float = POSITION_ERROR_RATIO
    command_delay_s: float = 0.0


class MasslessMobilityHandler(INodeHandler):
    """Moves the nodes at each update. Telemetry follows, in an event of its own for each node.

    Attributes:
        nodes: Registered nodes by id.
        targets: Targets (x, y, z) in meters by id; they stay after arrival.
        speeds: m/s by id.
        paths: Given paths by id: functions from simulated seconds to positions (x, y, z) in meters.
        position_errors: Errors of the positions that telemetry reports, by id.
    """

    def __init__(self, configuration: MasslessMobilityConfiguration | None = None) -> None:
        """Without a configuration the defaults of `MasslessMobilityConfiguration` hold."""
        self._configuration = checked_configuration(configuration, MasslessMobilityConfiguration)
        self._times = UpdateTimes(self._configuration.update_rate)
        self._settings: dict[int, _NodeSettings] = {}
        self._event_loop: EventLoop | None = None
        self._updates = 0
        self.nodes: dict[int, Node[Any]] = {}
        self.targets: dict[int, Position] = {}
        self.speeds: dict[int, float] = {}
        self.paths: dict[int, Callable[[float], Position]] = {}
        self.position_errors: dict[int, GaussMarkov] = {}
        self._telemetry: dict[float, TelemetryGroup] = {}

    @staticmethod
    def get_label() -> str:
        """Return "mobility"."""
        return "mobility"

    def configure_node(
        self,
        node_id: int,
        *,
        speed: float | None = None,
        telemetry_interval: float | None = None,
        stationary: bool = False,
        path: Callable[[float], Position] | None = None,
        position_error: float = 0.0,
        position_error_time: float = POSITION_ERROR_TIME_S,
        position_error_ratio: float = POSITION_ERROR_RATIO,
        command_delay: float = 0.0,
    ) -> None:
        """Set how one node moves, before it is registered. It holds in every simulation of this handler.

        Args:
            node_id: Its id.
            speed: m/s, >= 0, instead of the configuration's default.
            telemetry_interval: s: telemetry comes with the first update at or after each multiple. It is
                at least the time between two updates, which is also the default, or 0 for no telemetry.
            stationary: The node refuses every command.
            path: The position (x, y, z) in meters by the simulated time in seconds. It holds at each update,
                and the node refuses every command.
            position_error: Standard deviation of the error of reported positions; m on each horizontal axis,
                >= 0.
            position_error_time: Time in which this error changes, its correlation time; s, > 0.
            position_error_ratio: Standard deviation of the error of z over that of a horizontal axis, >= 0.
            command_delay: Time from a command until the vehicle obeys it; s, >= 0.

        Raises:
            ValueError: A number is outside its range.
            MasslessMobilityException: The node is registered already.
        """
        if node_id in self.nodes:
            raise MasslessMobilityException(f"node {node_id} is registered already: configure it before")
        if speed is not None:
            checked_number(f"speed of node {node_id}", speed, 0, unit="m/s")
        checked_number(f"position_error of node {node_id}", position_error, 0, unit="m")
        checked_number(f"position_error_time of node {node_id}", position_error_time, 0, above=True, unit="s")
        checked_number(f"position_error_ratio of node {node_id}", position_error_ratio, 0)
        checked_number(f"command_delay of node {node_id}", command_delay, 0, unit="s")
        rate = self._configuration.update_rate
        if telemetry_interval is not None and telemetry_interval != 0:
            checked_number(f"telemetry_interval of node {node_id}", telemetry_interval, 0, unit="s")
            if _in_updates(telemetry_interval, rate) < 1:
                raise ValueError(
                    f"telemetry_interval of node {node_id} is {telemetry_interval!r} s: expected 0 or at "
                    f"least the update_rate of the positions, {rate!r} s"
                )
        self._settings[node_id] = _NodeSettings(
            speed,
            telemetry_interval,
            stationary or path is not None,
            position_error,
            position_error_time,
            position_error_ratio,
            command_delay,
        )
        if path is not None:
            self.paths[node_id] = path

    def inject(self, event_loop: EventLoop) -> None:
        """Take the event loop of a new simulation; the first update comes one `update_rate` from now."""
        if self._event_loop is not None:
            self.nodes = {}
            self.targets = {}
            self.speeds = {}
            self.position_errors = {}
            self._telemetry = {}
        self._event_loop = event_loop
        self._times = UpdateTimes(self._configuration.update_rate, event_loop.current_time)
        self._updates = 0
        self._schedule_update(event_loop)

    def register_node(self, node: Node[Any]) -> None:
        """Let the node move. MasslessMobilityException if the event loop is missing."""
        if self._event_loop is None:
            raise MasslessMobilityException(f"cannot register node {node.id}: inject an event loop first")
        settings = self._settings.get(node.id, _NodeSettings())
        configuration = self._configuration
        self.nodes[node.id] = node
        self.speeds[node.id] = (
            configuration.default_speed if settings.speed_mps is None else settings.speed_mps
        )
        if settings.position_error_m > 0:
            self.position_errors[node.id] = position_error(
                node.seed,
                node.id,
                settings.position_error_m,
                settings.position_error_time_s,
                settings.position_error_ratio,
            )
        interval_s = settings.telemetry_interval_s
        if interval_s is None:
            interval_s = configuration.update_rate
        if interval_s != 0:
            interval = _in_updates(interval_s, configuration.update_rate)
            told = partial(self._reported_position, node) if node.id in self.position_errors else None
            self._telemetry.setdefault(interval, TelemetryGroup(interval)).add(node, told)

    def handle_command(self, command: MobilityCommand, node: Node[Any]) -> None:
        """Carry out GOTO_COORDS, GOTO_GEO_COORDS, or SET_SPEED with one parameter, after the command delay.

        It holds for the whole step of the next update. So a vehicle may turn up to one `update_rate` too
        early. A timer at 1 s runs before the update at 1 s: the vehicle turns at its position of 0.99 s.
        Raise MasslessMobilityException if the node is not registered or stationary, the command is unknown,
        or its parameters are not finite numbers in their range. A target is at most 1e7 m from the origin on
        each axis, as in integrated mode.
        """
        if node.id not in self.nodes:
            raise MasslessMobilityException(f"node {node.id} is not registered with the mobility handler")
        if getattr(command, "command_type", None) == MobilityCommandType.GOTO_GEO_COORDS:
            target = geo_target(command, node.id, self._configuration.reference_coordinates)
            command = GotoCoordsMobilityCommand(*target)
        can_move = node.id not in self._settings or not self._settings[node.id].refuses_commands
        if wrong := wrong_mobility(command, node.id, can_move):
            raise MasslessMobilityException(wrong)
        settings = self._settings.get(node.id)
        if settings is None or settings.command_delay_s == 0:
            self.obey(command, node)
            return
        event_loop = self._event_loop
        assert event_loop is not None
        due = time_after(event_loop.current_time, settings.command_delay_s)
        obey, context = partial(self.obey, command, node), context_of(node, "command")
        # In two events, so that an update at that time comes first: it moves the node up to there.
        event_loop.schedule_event(due, partial(event_loop.schedule_event, due, obey, context), context)

    def obey(self, command: MobilityCommand, node: Node[Any]) -> None:
        """Carry out GOTO_COORDS or SET_SPEED now, which are valid."""
        if command.command_type == MobilityCommandType.SET_SPEED:
            self.speeds[node.id] = float(cast("float", command.param_1))
        else:
            self.targets[node.id] = cast("Position", three_numbers(command))

    def _reported_position(self, node: Node[Any]) -> Position:
        assert self._event_loop is not None
        x, y, z = node.position
        dx, dy, dz = self.position_errors[node.id].at(self._event_loop.current_time)
        return (x + dx, y + dy, z + dz)

    def _schedule_update(self, event_loop: EventLoop) -> None:
        self._updates += 1
        event_loop.schedule_event(self._times.time_of(self._updates), self._update, "Mobility")

    def _update(self) -> None:
        event_loop = self._event_loop
        assert event_loop is not None
        self._move()
        now = event_loop.current_time
        for group in self._telemetry.values():
            if group.is_due(self._updates):
                event_loop.schedule_events(now, group.deliveries)
        self._schedule_update(event_loop)

    def _move(self) -> bool:
        """Move each node one step of speed * update_rate straight towards its target, and not beyond.

        Nodes with a path move on it. Return whether a node moved.
        """
        on_their_way = False
        update_rate = self._configuration.update_rate
        nodes = self.nodes
        for node_id, path in self.paths.items():
            on_their_way = True
            nodes[node_id].position = path(self._times.time_of(self._updates))
        speeds = self.speeds
        for node_id, target in self.targets.items():
            node = nodes[node_id]
            position = node.position
            if position == target:
                continue
            on_their_way = True
            x, y, z = position
            dx = target[0] - x
            dy = target[1] - y
            dz = target[2] - z
            distance = math.sqrt(dx * dx + dy * dy + dz * dz)
            step = speeds[node_id] * update_rate
            if distance <= step:
                node.position = target
            else:
                node.position = (x + dx / distance * step, y + dy / distance * step, z + dz / distance * step)
        return on_their_way


def _in_updates(interval_s: float, update_rate_s: float) -> float:
    """Return the length of an interval in updates, rounded if it is an integer but for rounding errors."""
    updates = interval_s / update_rate_s
    whole = round(updates)
    return float(whole) if math.isclose(updates, whole, rel_tol=1e-9) else updates


# Largest number of updates that are skipped at once.
_MOST_SKIPPED = 1 << 20


class IdleSkippingMobilityHandler(MasslessMobilityHandler):
    """Skips idle updates: no vehicle moves and no telemetry is due.

    The last update before each other event is never skipped. It schedules the next update, the first one that
    the other event can affect, at the usual time and place in the order of events. So only the number of
    events differs, if everything happens in events. Use `MasslessMobilityHandler` if you count events or act
    between them.
    """

    _moved = True

    def _move(self) -> bool:
        self._moved = super()._move()
        return self._moved

    def _schedule_update(self, event_loop: EventLoop) -> None:
        # The first update is scheduled before there are nodes. Often a group has telemetry at each update.
        if self._updates != 0 and not self._moved and 1.0 not in self._telemetry:
            self._updates = self._next_update(event_loop) - 1
        super()._schedule_update(event_loop)

    def _next_update(self, event_loop: EventLoop) -> int:
        following = self._updates + 1
        latest = following + _MOST_SKIPPED
        for group in self._telemetry.values():
            latest = min(latest, group.due)
        next_time = event_loop.next_time()
        if next_time is None:
            return latest
        return self._times.last_before(next_time, range(following, latest + 1))
