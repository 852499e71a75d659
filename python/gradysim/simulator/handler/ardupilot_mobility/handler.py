"""Lets autopilots fly the nodes of a simulation in real time."""

import asyncio
import contextlib
import logging
from collections.abc import Coroutine, Iterable
from pathlib import Path
from typing import Any

from gradysim.encapsulator.geo_target import geo_target
from gradysim.encapsulator.refused_commands import wrong_mobility
from gradysim.protocol.errors import MasslessMobilityException
from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    MobilityCommand,
    MobilityCommandType,
)
from gradysim.simulator.checked_configuration import checked_configuration
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.ardupilot_mobility.configuration import ArdupilotMobilityConfiguration
from gradysim.simulator.handler.ardupilot_mobility.exception import ArdupilotMobilityException
from gradysim.simulator.handler.ardupilot_mobility.flight import Flight
from gradysim.simulator.handler.ardupilot_mobility.pilot import is_velocity
from gradysim.simulator.handler.ardupilot_mobility.report import FILE_NAME, write_report
from gradysim.simulator.handler.interface import IAsyncNodeHandler
from gradysim.simulator.handler.mobility.update_times import UpdateTimes
from gradysim.simulator.node import Node
from gradysim.sitl.dialect import load_dialect
from gradysim.sitl.error import SitlError
from gradysim.sitl.fleet import Fleet

_logger = logging.getLogger(__name__)


class ArdupilotMobilityHandler(IAsyncNodeHandler):
    """Gives each node an autopilot. Before the simulation starts all take off and fly to their positions.

    The simulation has to keep to the wall clock (`real_time`), as autopilots do. When one of them ends, or
    leaves the mode in which it obeys, so does the simulation, with an `ArdupilotMobilityException`.

    Attributes:
        nodes: Registered nodes by id.
    """

    def __init__(self, configuration: ArdupilotMobilityConfiguration | None = None) -> None:
        """Without a configuration the defaults of `ArdupilotMobilityConfiguration` hold."""
        self._configuration = checked_configuration(configuration, ArdupilotMobilityConfiguration)
        self.nodes: dict[int, Node[Any]] = {}
        self._event_loop: EventLoop | None = None
        self._asyncio_loop: asyncio.AbstractEventLoop | None = None
        self._real_time = 0.0
        self._fleet: Fleet | None = None
        self._flights: dict[int, Flight] = {}
        self._tasks: list[asyncio.Task[None]] = []
        self._times = UpdateTimes(self._configuration.update_rate)
        self._updates = 0
        self._has_begun = False

    @staticmethod
    def get_label() -> str:
        """Return "mobility"."""
        return "mobility"

    def inject(self, event_loop: EventLoop) -> None:
        """Take the event loop of a new simulation."""
        self._close()
        self._event_loop = event_loop
        self._asyncio_loop = None
        self._times = UpdateTimes(self._configuration.update_rate, event_loop.current_time)
        self._updates = 0
        self._has_begun = False
        self._flights = {}
        self.nodes = {}

    def inject_async(self, asyncio_loop: asyncio.AbstractEventLoop, real_time: float) -> None:
        """Take the asyncio loop of a new simulation.

        Raises:
            ArdupilotMobilityException: The simulation is not in real time.
        """
        if real_time <= 0:
            raise ArdupilotMobilityException(
                "autopilots fly in real time, the simulation does not: "
                "set real_time=True, or a factor, in its SimulationConfiguration"
            )
        self._asyncio_loop = asyncio_loop
        self._real_time = real_time

    def register_node(self, node: Node[Any]) -> None:
        """Let an autopilot fly the node."""
        addresses = self._configuration.vehicle_addresses or {}
        if not self._configuration.simulate_drones and node.id not in addresses:
            raise ArdupilotMobilityException(
                f"node {node.id} has no vehicle: without simulate_drones, vehicle_addresses has to name one "
                f"for each node, it has {sorted(addresses)}"
            )
        self.nodes[node.id] = node

    def initialize(self) -> None:
        """Start the autopilots and fly all nodes to their initial positions, together.

        Raises:
            ModuleNotFoundError: The extra `sitl` is not installed.
            ArdupilotMobilityException: An autopilot cannot be started, or a step failed.
        """
        if self._event_loop is None or self._asyncio_loop is None:
            raise ArdupilotMobilityException(
                "the handler was given no simulation: inject_async was not called"
            )
        load_dialect()
        loop = self._asyncio_loop
        configuration = self._configuration
        self._tasks.append(loop.create_task(self._close_at_the_end()))
        try:
            if configuration.simulate_drones and self.nodes:
                self._fleet = Fleet(
                    configuration.ardupilot_path,
                    user=configuration.autopilot_user,
                    console_folder=configuration.uav_api_log_path,
                )
            for identifier, node in self.nodes.items():
                self._flights[identifier] = Flight(node, self._event_loop, configuration, self._real_time)
            _run(loop, self._take_off())
        except SitlError as error:
            raise ArdupilotMobilityException(str(error)) from error
        self._has_begun = True
        for flight in self._flights.values():
            task = loop.create_task(self._attend(flight))
            task.add_done_callback(_pass_on)
            self._tasks.append(task)
        self._event_loop.schedule_event(self._event_loop.current_time, self._update, "ArduPilot")

    def handle_command(self, command: MobilityCommand, node: Node[Any]) -> None:
        """Hand an order to a node's autopilot.

        Args:
            command: GOTO_COORDS, GOTO_GEO_COORDS, or SET_SPEED with one parameter, a ground speed, or three,
                a velocity. z is the height above the place where the vehicle was armed; a geographic altitude
                counts from that of the reference.
            node: A registered node.

        Raises:
            ArdupilotMobilityException: The node is not registered, the command means nothing, or its
                autopilot is gone.
        """
        if node.id not in self.nodes:
            raise ArdupilotMobilityException(f"node {node.id} is not registered with the mobility handler")
        if node.id not in self._flights:
            raise ArdupilotMobilityException(f"node {node.id} was given {command!r} before its take-off")
        try:
            self._flights[node.id].obey(self._checked(command, node.id))
        except MasslessMobilityException as error:
            raise ArdupilotMobilityException(str(error)) from None
        except ArdupilotMobilityException as error:
            raise ArdupilotMobilityException(f"node {node.id} was {error}") from error.__cause__
        except SitlError as error:
            raise ArdupilotMobilityException(str(error)) from error

    def finalize(self) -> None:
        """Write the report, and end the autopilots; real vehicles are left in the air."""
        try:
            if self._has_begun:
                for flight in self._flights.values():
                    flight.end()
                if self._configuration.generate_report:
                    reports = {identifier: flight.report for identifier, flight in self._flights.items()}
                    write_report(Path(FILE_NAME), reports)
                if not self._configuration.simulate_drones:
                    _logger.warning(
                        "The simulation is over; its vehicles are in the air and hold their position, "
                        "unless a failsafe of theirs takes over"
                    )
        finally:
            self._close()

    def _checked(self, command: MobilityCommand, node_id: int) -> MobilityCommand:
        """Return the command, to a place of the frame instead of a geographic one.

        Raises:
            MasslessMobilityException: It cannot be carried out, in the words of the other handlers.
        """
        if getattr(command, "command_type", None) == MobilityCommandType.GOTO_GEO_COORDS:
            place = geo_target(command, node_id, self._configuration.reference_coordinates)
            return GotoCoordsMobilityCommand(*place)
        if not is_velocity(command) and (wrong := wrong_mobility(command, node_id, can_move=True)):
            raise MasslessMobilityException(wrong)
        return command

    async def _take_off(self) -> None:
        await _all(flight.prepare(self._fleet) for flight in self._flights.values())
        is_simulated = self._fleet is not None
        await _all(flight.begin(is_simulated=is_simulated) for flight in self._flights.values())

    async def _attend(self, flight: Flight) -> None:
        try:
            await flight.attend()
        except SitlError as error:
            raise ArdupilotMobilityException(str(error)) from error

    async def _close_at_the_end(self) -> None:
        """Leave nothing behind when a simulation is dropped half-way: its tasks are cancelled then."""
        try:
            await asyncio.Event().wait()
        finally:
            self._close()

    def _close(self) -> None:
        """End what was started; no-op if that has happened."""
        for flight in self._flights.values():
            flight.close()
        for task in self._tasks:
            task.cancel()
        self._tasks = []
        if self._fleet is not None:
            self._fleet.close()
            self._fleet = None

    def _update(self) -> None:
        event_loop = self._event_loop
        assert event_loop is not None
        try:
            for flight in self._flights.values():
                flight.telemetry_is_due()
        except SitlError as error:
            raise ArdupilotMobilityException(str(error)) from error
        self._updates += 1
        event_loop.schedule_event(self._times.time_of(self._updates), self._update, "ArduPilot")


def _run(loop: asyncio.AbstractEventLoop, work: Coroutine[Any, Any, None]) -> None:
    """Run to the end; Ctrl-C, which may have hit any task, leaves none of them half-done."""
    task = loop.create_task(work)
    try:
        loop.run_until_complete(task)
    except KeyboardInterrupt:
        task.cancel()
        with contextlib.suppress(KeyboardInterrupt, asyncio.CancelledError, SitlError):
            loop.run_until_complete(task)
        raise


async def _all(steps: Iterable[Coroutine[Any, Any, None]]) -> None:
    """Do all at the same time. The first that fails cancels the others, and its exception passes through."""
    tasks = [asyncio.ensure_future(step) for step in steps]
    try:
        await asyncio.gather(*tasks)
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)


def _pass_on(task: asyncio.Task[None]) -> None:
    """Raise what ended a task, so that it ends the simulation."""
    if not task.cancelled():
        task.result()
