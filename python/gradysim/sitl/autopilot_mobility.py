"""Mobility handler for massless vehicles, quadcopters, and vehicles flown by autopilots."""

import weakref
from collections.abc import Mapping
from functools import partial
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from gradysim.motion.flight_controller import Airframe
from gradysim.motion.wind import Wind
from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.protocol.position import Position
from gradysim.simulator.handler.mobility.massless import MasslessMobilityConfiguration
from gradysim.simulator.handler.mobility.quadcopter import QuadcopterMobilityHandler
from gradysim.simulator.node import Node
from gradysim.sitl.flight_orders import give_order

if TYPE_CHECKING:
    from gradysim.sitl.flights import Flights


class AutopilotMobilityHandler(QuadcopterMobilityHandler):
    """Moves nodes with an autopilot to the position of its vehicle at each update.

    An autopilot is always one update ahead, as quadcopters are.
    """

    def __init__(
        self,
        configuration: MasslessMobilityConfiguration,
        flights: "Flights",
        quadcopters: Mapping[int, Airframe] = MappingProxyType({}),
        wind: Wind | None = None,
    ) -> None:
        """Create the handler. `flights` start with `take_off` and end with the simulation."""
        super().__init__(configuration, quadcopters, wind)
        self._flights = flights
        for node_id in flights.ids:
            self.paths[node_id] = partial(_position_of, flights, node_id)
        weakref.finalize(self, flights.close)  # If the simulation is not finished.

    def take_off(self) -> None:
        """Start the autopilots. Raise SitlError if one does not start or a step of its flight fails."""
        self._flights.begin()

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

    def _fly_on(self) -> None:
        super()._fly_on()
        self._flights.advance_to(self._times.time_of(self._updates))


def _position_of(flights: "Flights", node_id: int, _time_s: float) -> Position:
    return flights.position(node_id)
