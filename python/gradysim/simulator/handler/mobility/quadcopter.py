"""Mobility handler for vehicles with inertia: quadcopters, and vehicles that autopilots fly."""

import math
import weakref
from collections.abc import Mapping
from functools import partial
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from gradysim.motion.flight_controller import STEP_S, Airframe, FlightController
from gradysim.motion.wind import Wind, WindAtVehicle
from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.protocol.position import Position
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.mobility.massless import (
    MasslessMobilityConfiguration,
    MasslessMobilityHandler,
)
from gradysim.simulator.node import Node

if TYPE_CHECKING:
    from gradysim.encapsulator.autopilots import Flights


class QuadcopterMobilityHandler(MasslessMobilityHandler):
    """Flies some nodes as quadcopters: by a built-in controller, or by autopilots. Others move as usual.

    A quadcopter is always one update ahead: after the telemetry of an update it flies to the next one. So a
    command takes effect at the first update after it, or at once if it is sent by `handle_telemetry`.
    """

    def __init__(
        self,
        configuration: MasslessMobilityConfiguration | None = None,
        quadcopters: Mapping[int, Airframe] = MappingProxyType({}),
        wind: Wind | None = None,
        flights: "Flights | None" = None,
    ) -> None:
        """Create the handler.

        Args:
            configuration: Motion of all nodes.
            quadcopters: The vehicles with the built-in controller, by the ids of nodes.
            wind: Wind that blows on these vehicles.
            flights: The vehicles with autopilots. They start with `take_off` and end with the simulation.

        Raises:
            ValueError: There are quadcopters, and the update_rate is not a multiple of 10 ms.
        """
        super().__init__(configuration)
        self._quadcopters = dict(quadcopters)
        self._wind = wind or Wind()
        self._flown: dict[int, FlightController] = {}
        rate_s = self._configuration.update_rate
        self._steps = round(rate_s / STEP_S)
        if self._quadcopters and not (self._steps > 0 and math.isclose(self._steps * STEP_S, rate_s)):
            raise ValueError(
                f"update_rate is {rate_s!r} s: expected a multiple of {STEP_S} s for quadcopters"
            )
        for node_id in self._quadcopters:
            self.paths[node_id] = partial(self._position_of, node_id)
        self._flights = flights
        if flights is not None:
            for node_id in flights.ids:
                self.paths[node_id] = partial(_position_of, flights, node_id)
            weakref.finalize(self, flights.close)  # If the simulation is not finished.

    def take_off(self) -> None:
        """Start the autopilots. Raise SitlError if one does not start or a step of its flight fails."""
        if self._flights is not None:
            self._flights.begin()

    def inject(self, event_loop: EventLoop) -> None:
        """Take the event loop of a new simulation."""
        super().inject(event_loop)
        self._flown = {}

    def register_node(self, node: Node[Any]) -> None:
        """Let the node move; a quadcopter hovers where it is."""
        super().register_node(node)
        if node.id in self._quadcopters:
            self._flown[node.id] = FlightController(
                node.position,
                self.speeds[node.id],
                WindAtVehicle(self._wind, node.seed, node.id),
                self.position_errors.get(node.id),
                self._quadcopters[node.id],
            )

    def initialize(self) -> None:
        """Schedule the first flight, after the protocols have started."""
        super().initialize()
        self._schedule_flight()

    def handle_command(self, command: MobilityCommand, node: Node[Any]) -> None:
        """Carry out a command, at once if the node has an autopilot.

        Raise MasslessMobilityException if it is not valid, SitlError if the autopilot has ended.
        """
        if self._flights is not None and node.id in self._flights.ids:
            self._flights.give_order(command, node.id)
        else:
            super().handle_command(command, node)

    def obey(self, command: MobilityCommand, node: Node[Any]) -> None:
        """Carry out a valid command now."""
        super().obey(command, node)
        if node.id in self._flown:
            vehicle = self._flown[node.id]
            vehicle.speed_mps = self.speeds[node.id]
            if (target := self.targets.pop(node.id, None)) is not None:
                vehicle.go_to(target)

    def _position_of(self, node_id: int, _time_s: float) -> Position:
        return self._flown[node_id].position

    def _move(self) -> bool:
        super()._move()
        return True

    def _update(self) -> None:
        super()._update()
        self._schedule_flight()

    def _schedule_flight(self) -> None:
        """Fly to the next update after all events of this instant."""
        event_loop: EventLoop | None = self._event_loop
        assert event_loop is not None
        event_loop.schedule_event(event_loop.current_time, self._fly_on, "Flight")

    def _fly_on(self) -> None:
        for vehicle in self._flown.values():
            for _ in range(self._steps):
                vehicle.step()
        if self._flights is not None:
            self._flights.advance_to(self._times.time_of(self._updates))

    def finalize(self) -> None:
        """End the autopilots."""
        super().finalize()
        if self._flights is not None:
            self._flights.close()


def _position_of(flights: "Flights", node_id: int, _time_s: float) -> Position:
    return flights.position(node_id)
