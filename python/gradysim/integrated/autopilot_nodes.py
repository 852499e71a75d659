"""Nodes of the engine that are flown by autopilots."""

import math
import weakref
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from gradysim.encapsulator.autopilots import flights_of
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


class AutopilotNodes:
    """Moves nodes of the engine with the vehicles of a scenario. Does nothing if there are none.

    An autopilot is always one update ahead, so the path of its node is known up to the next update.
    """

    def __init__(self, scenario: Scenario, network: "Network", nodes: Sequence["Node"]) -> None:
        """Create the flights without starting them. Raise ConfigError if a node cannot be flown."""
        self._network = network
        self._flights = flights_of(scenario)
        self._nodes = [node for node in nodes if self._flights is not None and node.id in self._flights.ids]
        self._updates = 0
        self._updates_hz = round(1 / UPDATE_S)
        if self._flights is not None:
            weakref.finalize(self, self._flights.close)  # If the run is not finished.

    def take_off(self) -> None:
        """Start the autopilots and fly their vehicles to the starts. SitlError if a step of that fails."""
        if self._flights is not None:
            self._flights.begin()

    def steering_of(self, node_id: int) -> Callable[[MobilityCommand], None] | None:
        """Return the function for mobility commands of a node with an autopilot, or None."""
        flights = self._flights
        if flights is None or node_id not in flights.ids:
            return None
        return lambda command: flights.give_order(command, node_id)

    def initialize(self) -> None:
        """Schedule the first update, after the protocols have started."""
        if self._nodes:
            self._schedule_flight()

    def close(self) -> None:
        """End the autopilots. Do nothing if they have ended."""
        if self._flights is not None:
            self._flights.close()

    def _fly_on(self) -> None:
        """Fly to the next update and move the nodes there by then."""
        flights = self._flights
        assert flights is not None
        self._updates += 1
        next_s = self._updates / self._updates_hz
        flights.advance_to(next_s)
        for node in self._nodes:
            self._move(node, flights.position(node.id))
        self._network.schedule(next_s, self._let_others_pass)

    def _let_others_pass(self) -> None:
        """Delay the next update until the telemetry of this instant is handled."""
        self._network.schedule(self._network.now, self._schedule_flight)

    def _schedule_flight(self) -> None:
        self._network.schedule(self._network.now, self._fly_on)

    def _move(self, node: "Node", target: Position) -> None:
        """Move a node in a straight line to `target` by the next update."""
        distance_m = math.dist(node.position, target)
        if distance_m > 0:
            node.send_mobility_command(SetSpeedMobilityCommand(distance_m * self._updates_hz))
            node.send_mobility_command(GotoCoordsMobilityCommand(*target))
