"""Autopilots of the nodes of a scenario, as both modes use them.

The package `gradysim.sitl` flies them. It is loaded only for a scenario with such nodes.
"""

from collections.abc import Collection
from importlib import import_module
from typing import TYPE_CHECKING, Any, Protocol

from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.protocol.position import Position

if TYPE_CHECKING:
    from gradysim.scenario.scenario import Scenario


class Flights(Protocol):
    """All vehicles of a simulation that autopilots fly. A failure of an autopilot raises SitlError."""

    @property
    def ids(self) -> Collection[int]:
        """Ids of the nodes."""

    def begin(self) -> None:
        """Start all autopilots, take off and fly to the starts. Simulated time is 0 then."""

    def advance_to(self, time_s: float) -> None:
        """Fly until `time_s` of simulated time."""

    def position(self, node_id: int) -> Position:
        """Return the position of a node (x, y, z) in meters."""

    def give_order(self, command: MobilityCommand, node_id: int) -> None:
        """Carry out a mobility command. MasslessMobilityException if it is not valid."""

    def close(self) -> None:
        """End all autopilots. Do nothing if they have ended."""


def check_autopilots(scenario: "Scenario") -> None:
    """Raise ConfigError, at the line in the .ini file, if autopilots cannot fly their nodes."""
    if _has_autopilots(scenario):
        _sitl().check_autopilots(scenario)


def flights_of(scenario: "Scenario") -> Flights | None:
    """Return the flights of all nodes with an autopilot, not started; None without such nodes.

    Raises ConfigError as `check_autopilots`.
    """
    flights: Flights | None = _sitl().flights_of(scenario) if _has_autopilots(scenario) else None
    return flights


def _has_autopilots(scenario: "Scenario") -> bool:
    return any(spec.autopilot is not None for spec in scenario.nodes)


def _sitl() -> Any:
    return import_module("gradysim.sitl.scenario_autopilots")
