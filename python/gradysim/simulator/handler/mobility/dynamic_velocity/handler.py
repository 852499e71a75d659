"""Handler of vehicles steered by velocity, with limited speed and acceleration."""

from collections.abc import Callable
from typing import Any

from gradysim.encapsulator.validation import three_numbers
from gradysim.protocol.messages.mobility import MobilityCommand, MobilityCommandType
from gradysim.simulator.event import EventLoop, ScheduledEvent
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.handler.mobility.dynamic_velocity.config import (
    DynamicVelocityMobilityConfiguration,
    DynamicVelocityMobilityException,
)
from gradysim.simulator.handler.mobility.dynamic_velocity.core import (
    apply_velocity_limits,
    apply_velocity_tracking_first_order,
    integrate_position,
)
from gradysim.simulator.handler.mobility.dynamic_velocity.telemetry import DynamicVelocityTelemetry, Velocity
from gradysim.simulator.handler.mobility.updates import UpdateTimes
from gradysim.simulator.log import context_of
from gradysim.simulator.node import Node

_AT_REST: Velocity = (0.0, 0.0, 0.0)


class DynamicVelocityMobilityHandler(INodeHandler):
    """Moves the nodes at each update: acceleration, then speed limits, then position.

    A velocity holds until the next command; before the first command a node is at rest. Telemetry is a
    `DynamicVelocityTelemetry`. It follows the update in a separate event for each node.

    Attributes:
        nodes: Registered nodes by id.
        velocities: Current (vx, vy, vz) in m/s by id.
        desired_velocities: Commanded velocities by id.
    """

    def __init__(self, config: DynamicVelocityMobilityConfiguration) -> None:
        if not isinstance(config, DynamicVelocityMobilityConfiguration):
            raise TypeError(f"expected a DynamicVelocityMobilityConfiguration, got {config!r}")
        self._config = config
        self._event_loop: EventLoop | None = None
        self._times = UpdateTimes(config.update_rate)
        self._updates = 0
        self.nodes: dict[int, Node[Any]] = {}
        self.velocities: dict[int, Velocity] = {}
        self.desired_velocities: dict[int, Velocity] = {}
        self._deliveries: list[ScheduledEvent] = []

    @staticmethod
    def get_label() -> str:
        """Return "mobility"."""
        return "mobility"

    def inject(self, event_loop: EventLoop) -> None:
        """Take the event loop of a new simulation."""
        if self._event_loop is not None:
            self.nodes = {}
            self.velocities = {}
            self.desired_velocities = {}
            self._deliveries = []
        self._event_loop = event_loop
        self._updates = 0

    def register_node(self, node: Node[Any]) -> None:
        """Add a node to move."""
        self.nodes[node.id] = node
        self.velocities[node.id] = self.desired_velocities[node.id] = _AT_REST
        self._deliveries.append((self._delivery(node), context_of(node, "handle_telemetry")))

    def initialize(self) -> None:
        """Start to move, if there are nodes; the first update comes one `update_rate` from now."""
        if self.nodes and self._event_loop is not None:
            self._times = UpdateTimes(self._config.update_rate, self._event_loop.current_time)
            self._schedule_update(self._event_loop)

    def handle_command(self, command: MobilityCommand, node: Node[Any]) -> None:
        """Set the velocity that a vehicle should fly, from the next update on.

        Raise DynamicVelocityMobilityException if the node is not registered, or the command is not a
        SET_SPEED with three finite numbers, as in SetVelocityMobilityCommand.
        """
        if node.id not in self.nodes:
            raise DynamicVelocityMobilityException(
                f"node {node.id} is not registered with the mobility handler"
            )
        if getattr(command, "command_type", None) != MobilityCommandType.SET_SPEED:
            raise DynamicVelocityMobilityException(
                f"node {node.id} is steered by velocity and cannot carry out {command!r}: "
                "use SetVelocityMobilityCommand(vx, vy, vz)"
            )
        velocity = three_numbers(command)
        if velocity is None:
            given = (command.param_1, command.param_2, command.param_3)
            raise DynamicVelocityMobilityException(
                f"node {node.id} was given the velocity {given!r}: expected three finite numbers of m/s, as "
                "of SetVelocityMobilityCommand(vx, vy, vz)"
            )
        self.desired_velocities[node.id] = velocity

    def _schedule_update(self, event_loop: EventLoop) -> None:
        self._updates += 1
        event_loop.schedule_event(self._times.time_of(self._updates), self._update, "Mobility")

    def _update(self) -> None:
        event_loop = self._event_loop
        assert event_loop is not None
        for node_id, node in self.nodes.items():
            self._move(node_id, node)
        config = self._config
        if config.send_telemetry and self._updates % config.telemetry_decimation == 0:
            event_loop.schedule_events(event_loop.current_time, self._deliveries)
        self._schedule_update(event_loop)

    def _move(self, node_id: int, node: Node[Any]) -> None:
        config = self._config
        velocity = self.velocities[node_id]
        desired = self.desired_velocities[node_id]
        if velocity != desired:
            velocity = self._accelerated(velocity, desired)
            self.velocities[node_id] = velocity
        if velocity != _AT_REST:
            node.position = integrate_position(node.position, velocity, config.update_rate)

    def _accelerated(self, velocity: Velocity, desired: Velocity) -> Velocity:
        config = self._config
        velocity = apply_velocity_tracking_first_order(
            velocity,
            desired,
            config.update_rate,
            config.max_acc_xy,
            config.max_acc_z,
            config.tau_xy,
            config.tau_z,
        )
        return apply_velocity_limits(velocity, config.max_speed_xy, config.max_speed_z)

    def _delivery(self, node: Node[Any]) -> Callable[[], None]:
        velocities = self.velocities

        def deliver() -> None:
            telemetry = DynamicVelocityTelemetry(node.position, velocities[node.id])
            node.protocol_encapsulator.handle_telemetry(telemetry)

        return deliver
