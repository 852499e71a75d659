"""Mobility handler that flies the nodes of a simulation by autopilots."""

import asyncio
from pathlib import Path
from typing import Any

from gradysim.protocol.errors import MasslessMobilityException
from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.interface import IAsyncNodeHandler
from gradysim.simulator.node import Node
from gradysim.simulator.validation import checked_configuration
from gradysim.sitl import ArdupilotMobilityException
from gradysim.sitl.ardupilot_mobility.configuration import ArdupilotMobilityConfiguration
from gradysim.sitl.ardupilot_mobility.lock_step import LockStep
from gradysim.sitl.ardupilot_mobility.real_time import FreeRunning
from gradysim.sitl.ardupilot_mobility.report import FILE_NAME, write_report
from gradysim.sitl.mavlink import load_dialect


class ArdupilotMobilityHandler(IAsyncNodeHandler):
    """Gives each node an autopilot. All take off and fly to their positions before the simulation starts.

    Simulated autopilots fly on simulated time, in lock-step with the simulation, unless it runs in real time
    (`real_time`). Real vehicles need real time. When an autopilot ends or leaves mode GUIDED, the simulation
    ends with an `ArdupilotMobilityException`.

    Attributes:
        nodes: Registered nodes by id.
    """

    def __init__(self, configuration: ArdupilotMobilityConfiguration | None = None) -> None:
        """Create the handler, with the default `ArdupilotMobilityConfiguration` if none is given."""
        self._configuration = checked_configuration(configuration, ArdupilotMobilityConfiguration)
        self.nodes: dict[int, Node[Any]] = {}
        self._event_loop: EventLoop | None = None
        self._asyncio_loop: asyncio.AbstractEventLoop | None = None
        self._real_time = 0.0
        self._flying: FreeRunning | LockStep | None = None
        self._has_begun = False

    @staticmethod
    def get_label() -> str:
        """Return "mobility"."""
        return "mobility"

    def inject(self, event_loop: EventLoop) -> None:
        """Set the event loop of a new simulation."""
        self._close()
        self._event_loop = event_loop
        self._asyncio_loop = None
        self._has_begun = False
        self.nodes = {}

    def inject_async(self, asyncio_loop: asyncio.AbstractEventLoop, real_time: float) -> None:
        """Set the asyncio loop of a new simulation.

        Raise ArdupilotMobilityException if the settings need real time, and the simulation has none.
        """
        configuration, needs = self._configuration, ""
        if not configuration.simulate_drones:
            needs = "real vehicles need"
        elif configuration.ground_station_ip is not None:
            needs = "a ground station needs"
        if real_time <= 0 and needs:
            raise ArdupilotMobilityException(
                f"{needs} real time: set real_time=True, or a factor, in the SimulationConfiguration"
            )
        self._asyncio_loop = asyncio_loop
        self._real_time = real_time

    def register_node(self, node: Node[Any]) -> None:
        """Register a node to be flown by an autopilot."""
        addresses = self._configuration.vehicle_addresses or {}
        if not self._configuration.simulate_drones and node.id not in addresses:
            raise ArdupilotMobilityException(
                f"node {node.id} has no vehicle: without simulate_drones, vehicle_addresses must have one "
                f"for each node, it has {sorted(addresses)}"
            )
        self.nodes[node.id] = node

    def initialize(self) -> None:
        """Start the autopilots and fly all nodes to their initial positions.

        Raise ModuleNotFoundError if the extra `sitl` is not installed, and ArdupilotMobilityException if an
        autopilot cannot start, or a step failed.
        """
        if self._event_loop is None or self._asyncio_loop is None:
            raise ArdupilotMobilityException("the handler has no simulation: inject_async was not called")
        load_dialect()
        if self._real_time > 0:
            self._flying = FreeRunning(
                self.nodes, self._configuration, self._event_loop, self._asyncio_loop, self._real_time
            )
        else:
            self._flying = LockStep(self.nodes, self._configuration, self._event_loop)
        self._flying.begin()
        self._has_begun = True

    def handle_command(self, command: MobilityCommand, node: Node[Any]) -> None:
        """Send a command to the autopilot of a node: GOTO_COORDS, GOTO_GEO_COORDS or SET_SPEED.

        SET_SPEED has one parameter (ground speed) or three (velocity). z is the height above the place where
        the vehicle was armed. A geographic altitude counts from that of the reference. Raise
        ArdupilotMobilityException if the node is not registered, the command is not valid, or the autopilot
        has ended.
        """
        if node.id not in self.nodes:
            raise ArdupilotMobilityException(f"node {node.id} is not registered with the mobility handler")
        if self._flying is None or not self._has_begun:
            raise ArdupilotMobilityException(f"node {node.id} got {command!r} before its take-off")
        try:
            self._flying.handle_command(command, node)
        except MasslessMobilityException as error:
            raise ArdupilotMobilityException(str(error)) from error.__cause__

    def finalize(self) -> None:
        """Write the report and end the autopilots. Real vehicles stay in the air."""
        try:
            if self._has_begun and self._flying is not None:
                reports = self._flying.end()
                if self._configuration.generate_report:
                    write_report(Path(FILE_NAME), reports)
        finally:
            self._close()

    def _close(self) -> None:
        """End the autopilots. Do nothing if they have ended."""
        if self._flying is not None:
            self._flying.close()
            self._flying = None
