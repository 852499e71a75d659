"""Massless vehicles and some that autopilots fly, side by side."""

import weakref
from typing import TYPE_CHECKING, Any

from gradysim.encapsulator.flight_orders import give_order
from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.mobility.massless import (
    MasslessMobilityConfiguration,
    MasslessMobilityHandler,
)
from gradysim.simulator.node import Node

if TYPE_CHECKING:
    from gradysim.sitl.flights import Flights


class FlownMobilityHandler(MasslessMobilityHandler):
    """At each update the nodes with an autopilot are where its vehicle is; they obey by it.

    An autopilot is always one update ahead: as positions are told, it flies on to the next ones. So an order
    takes effect at the first update after it, or at once if it answers telemetry.
    """

    def __init__(self, configuration: MasslessMobilityConfiguration, flights: "Flights") -> None:
        """`flights` begin by `take_off` and end with the simulation."""
        super().__init__(configuration)
        self._flights = flights
        weakref.finalize(self, flights.close)  # Of a simulation that is dropped half-way.

    def take_off(self) -> None:
        """Start the autopilots; SitlError if one does not start, or a step of its flight failed."""
        self._flights.begin()

    def initialize(self) -> None:
        """Plan the first flight, after `take_off`: until the first update nodes stay where they were put."""
        super().initialize()
        self._schedule_flight()

    def handle_command(self, command: MobilityCommand, node: Node[Any]) -> None:
        """Carry out an order to a vehicle.

        Raises:
            MasslessMobilityException: It cannot be carried out.
            SitlError: The autopilot is gone.
        """
        if node.id in self._flights.ids:
            reference = self._configuration.reference_coordinates
            give_order(command, node.id, reference, self._flights.pilot(node.id))
        else:
            super().handle_command(command, node)

    def finalize(self) -> None:
        """End the autopilots."""
        super().finalize()
        self._flights.close()

    def _move(self) -> bool:
        super()._move()
        self._follow()
        return True

    def _update(self) -> None:
        super()._update()
        self._schedule_flight()

    def _follow(self) -> None:
        for identifier in self._flights.ids:
            self.nodes[identifier].position = self._flights.position(identifier)

    def _schedule_flight(self) -> None:
        """Fly on when all that happens now has happened."""
        event_loop: EventLoop | None = self._event_loop
        assert event_loop is not None
        event_loop.schedule_event(event_loop.current_time, self._fly_on, "ArduPilot")

    def _fly_on(self) -> None:
        self._flights.advance_to(self._times.time_of(self._updates))
