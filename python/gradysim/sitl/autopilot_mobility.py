"""Mobility handler for massless vehicles and vehicles flown by autopilots."""

import weakref
from typing import TYPE_CHECKING, Any

from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.mobility.massless import (
    MasslessMobilityConfiguration,
    MasslessMobilityHandler,
)
from gradysim.simulator.node import Node
from gradysim.sitl.flight_orders import give_order

if TYPE_CHECKING:
    from gradysim.sitl.flights import Flights


class AutopilotMobilityHandler(MasslessMobilityHandler):
    """Moves nodes with an autopilot to the position of its vehicle at each update.

    An autopilot is always one update ahead: after the telemetry of an update it flies to the next one. So a
    command takes effect at the first update after it, or at once if it is sent by `handle_telemetry`.
    """

    def __init__(self, configuration: MasslessMobilityConfiguration, flights: "Flights") -> None:
        """Create the handler. `flights` start with `take_off` and end with the simulation."""
        super().__init__(configuration)
        self._flights = flights
        weakref.finalize(self, flights.close)  # If the simulation is not finished.

    def take_off(self) -> None:
        """Start the autopilots. Raise SitlError if one does not start or a step of its flight fails."""
        self._flights.begin()

    def initialize(self) -> None:
        """Schedule the first update, after `take_off`."""
        super().initialize()
        self._schedule_flight()

    def handle_command(self, command: MobilityCommand, node: Node[Any]) -> None:
        """Carry out a command.

        Raise MasslessMobilityException if it is not valid, SitlError if the autopilot has ended.
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
        for identifier in self._flights.ids:
            self.nodes[identifier].position = self._flights.position(identifier)
        return True

    def _update(self) -> None:
        super()._update()
        self._schedule_flight()

    def _schedule_flight(self) -> None:
        """Fly to the next update after all events of this instant."""
        event_loop: EventLoop | None = self._event_loop
        assert event_loop is not None
        event_loop.schedule_event(event_loop.current_time, self._fly_on, "ArduPilot")

    def _fly_on(self) -> None:
        self._flights.advance_to(self._times.time_of(self._updates))
