"""Nodes of the engine that autopilots fly."""

import math
import weakref
from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

from gradysim.autopilots.scenario_flights import flights_of
from gradysim.encapsulator.flight_orders import give_order
from gradysim.protocol.defaults import UPDATE_S
from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    MobilityCommand,
    SetSpeedMobilityCommand,
)
from gradysim.protocol.position import Position
from gradysim.scenario.scenario import Scenario

if TYPE_CHECKING:
    from gradysim._netsim import Network, Node


class FlownNodes:
    """Lets the engine's nodes follow the vehicles of a scenario; does nothing if there are none.

    An autopilot is always one update ahead, so that the course of its node is known up to the next one.
    """

    def __init__(self, scenario: Scenario, network: "Network", nodes: Sequence["Node"]) -> None:
        """Nothing is started yet. Raises ConfigError when a node cannot be flown."""
        self._network = network
        self._reference = scenario.reference_coordinates
        self._flights = flights_of(scenario)
        self._nodes = [node for node in nodes if self._flights is not None and node.id in self._flights.ids]
        self._updates = 0
        self._updates_hz = round(1 / UPDATE_S)
        if self._flights is not None:
            weakref.finalize(self, self._flights.close)  # Of a run that is dropped half-way.

    def take_off(self) -> None:
        """Start the autopilots; when this returns their vehicles hover where the nodes start.

        Raises:
            SitlError: An autopilot does not start, or a step of a flight failed.
        """
        if self._flights is not None:
            self._flights.begin()

    def steering_of(self, node_id: int) -> Callable[[MobilityCommand], None] | None:
        """Return what takes the mobility commands of a node's protocol; None if the engine does."""
        if self._flights is None or node_id not in self._flights.ids:
            return None
        return partial(self._order, node_id)

    def initialize(self) -> None:
        """Schedule the first flight: after the protocols have begun."""
        if self._nodes:
            self._schedule_flight()

    def close(self) -> None:
        """End the autopilots; no-op if that has happened."""
        if self._flights is not None:
            self._flights.close()

    def _order(self, node_id: int, command: MobilityCommand) -> None:
        assert self._flights is not None
        give_order(command, node_id, self._reference, self._flights.pilot(node_id))

    def _fly_on(self) -> None:
        """Fly to the next update, and let the nodes be there by then."""
        flights = self._flights
        assert flights is not None
        self._updates += 1
        next_s = self._updates / self._updates_hz
        flights.advance_to(next_s)
        for node in self._nodes:
            self._move(node, flights.position(node.id))
        self._network.schedule(next_s, self._let_others_pass)

    def _let_others_pass(self) -> None:
        """Put the next flight off until the telemetry of this instant has been told, and answered."""
        self._network.schedule(self._network.now, self._schedule_flight)

    def _schedule_flight(self) -> None:
        self._network.schedule(self._network.now, self._fly_on)

    def _move(self, node: "Node", target: Position) -> None:
        """Let a node be at a place by the next update: straight on."""
        distance_m = math.dist(node.position, target)
        if distance_m > 0:
            node.send_mobility_command(SetSpeedMobilityCommand(distance_m * self._updates_hz))
            node.send_mobility_command(GotoCoordsMobilityCommand(*target))
