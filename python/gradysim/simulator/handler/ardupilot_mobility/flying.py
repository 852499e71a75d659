"""What flies the nodes of a simulation: autopilots on the wall's time, or on simulated time."""

from collections.abc import Mapping
from typing import Protocol

from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.simulator.handler.ardupilot_mobility.report import NodeReport


class Flying(Protocol):
    """All vehicles of a simulation. What goes wrong with them is a SitlError."""

    def begin(self) -> None:
        """Take off and fly to the initial positions; returns when all are there."""

    def obey(self, command: MobilityCommand, node_id: int) -> None:
        """Carry out a command of a node's protocol; raises as `give_order`."""

    def end(self) -> Mapping[int, NodeReport]:
        """Return what is told of each node after the simulation."""

    def close(self) -> None:
        """End what was started; no-op if that has happened."""
