"""Autopilots on simulated time: as fast as possible, and repeatable."""

import logging
import math
from collections.abc import Mapping
from functools import partial
from typing import Any

from gradysim.protocol.defaults import UPDATE_S
from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.mobility.massless import MasslessMobilityConfiguration
from gradysim.simulator.handler.mobility.quadcopter import QuadcopterMobilityHandler
from gradysim.simulator.log import label_node
from gradysim.simulator.node import Node
from gradysim.sitl.ardupilot_mobility.configuration import ArdupilotMobilityConfiguration
from gradysim.sitl.ardupilot_mobility.report import NodeReport
from gradysim.sitl.autopilot_node import AutopilotNode
from gradysim.sitl.flights import Flights

_logger = logging.getLogger(__name__)


class LockStep:
    """All vehicles of a simulation, in lock-step with it. Failures of autopilots in flight end it."""

    def __init__(
        self,
        nodes: Mapping[int, Node[Any]],
        configuration: ArdupilotMobilityConfiguration,
        event_loop: EventLoop,
    ) -> None:
        """Create the vehicles of the nodes."""
        self._telemetry_s = configuration.update_rate
        self._event_loop = event_loop
        self._begin_s = event_loop.current_time
        self._reports: dict[int, NodeReport] = {}
        level = logging.INFO if configuration.uav_api_log_console else logging.DEBUG
        self._flights = Flights(
            [
                AutopilotNode(
                    id=node.id,
                    name=f"node {node.id} ({label_node(node)})",
                    start=node.position,
                    speed_mps=configuration.default_speed,
                    program=configuration.ardupilot_path,
                    user=configuration.autopilot_user,
                    parameters=configuration.autopilot_parameters or {},
                )
                for node in nodes.values()
            ],
            configuration.reference_coordinates,
            on_text=partial(_logger.log, level, "%s says: %s"),
            console_folder=configuration.uav_api_log_path,
            timeout_s=configuration.uav_api_startup_timeout,
        )
        # An integer number of updates per telemetry message.
        update_s = self._telemetry_s / math.ceil(self._telemetry_s / UPDATE_S - 1e-9)
        reference = configuration.reference_coordinates
        motion = MasslessMobilityConfiguration(update_rate=update_s, reference_coordinates=reference)
        self._mobility = QuadcopterMobilityHandler(motion, flights=self._flights)
        self._mobility.inject(event_loop)
        for node in nodes.values():
            self._mobility.configure_node(node.id, telemetry_interval=self._telemetry_s)
            self._mobility.register_node(node)

    def begin(self) -> None:
        """Start the autopilots and fly all nodes to their initial positions."""
        self._mobility.take_off()
        for identifier in self._mobility.nodes:
            self._reports[identifier] = NodeReport(battery_start=self._flights.battery_percent(identifier))
        self._mobility.initialize()

    def handle_command(self, command: MobilityCommand, node: Node[Any]) -> None:
        """Let the autopilot of a node carry out a command. Raise as `give_order`."""
        self._mobility.handle_command(command, node)

    def end(self) -> Mapping[int, NodeReport]:
        """Return the reports. Telemetries are never dropped, and clocks have no error."""
        duration_s = self._event_loop.current_time - self._begin_s
        telemetries = math.floor(duration_s / self._telemetry_s + 1e-6)
        for identifier, report in self._reports.items():
            report.requests = telemetries
            report.battery_end = self._flights.battery_percent(identifier)
        return self._reports

    def close(self) -> None:
        """End the autopilots."""
        self._flights.close()
