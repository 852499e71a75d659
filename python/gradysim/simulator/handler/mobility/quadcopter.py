"""Mobility handler for massless vehicles and quadcopters, which have inertia."""

import math
from collections.abc import Mapping
from functools import partial
from types import MappingProxyType
from typing import Any

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


class QuadcopterMobilityHandler(MasslessMobilityHandler):
    """Flies some nodes as quadcopters with a built-in controller. The others move as usual.

    A quadcopter is always one update ahead: after the telemetry of an update it flies to the next one. So a
    command takes effect at the first update after it, or at once if it is sent by `handle_telemetry`.
    """

    def __init__(
        self,
        configuration: MasslessMobilityConfiguration | None = None,
        quadcopters: Mapping[int, Airframe] = MappingProxyType({}),
        wind: Wind | None = None,
    ) -> None:
        """Create the handler. `quadcopters` are the vehicles by the ids of nodes, and `wind` blows on them.

        Raise ValueError if there are quadcopters, and the update_rate is not a multiple of 10 ms.
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
