"""Autopilots in real time, simulated or real ones, beside a simulation that keeps to the wall clock."""

import asyncio
import contextlib
import logging
import math
from collections.abc import Coroutine, Iterable, Mapping
from typing import Any

from gradysim.encapsulator.nested_loop import outer_loop_stands
from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.position import Position, geo_to_cartesian
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.mobility.updates import UpdateTimes
from gradysim.simulator.log import context_of, label_node
from gradysim.simulator.node import Node
from gradysim.sitl import SitlError
from gradysim.sitl.ardupilot_mobility.configuration import ArdupilotMobilityConfiguration
from gradysim.sitl.ardupilot_mobility.report import NodeReport
from gradysim.sitl.autopilot_node import check_start
from gradysim.sitl.connection import Connection, GroundStationPort, connect, open_ground_station
from gradysim.sitl.fleet import Fleet
from gradysim.sitl.flight_orders import give_order
from gradysim.sitl.frame import cartesian_to_geo, check_same_hemisphere, home_of
from gradysim.sitl.mavlink import MavlinkLink, Message
from gradysim.sitl.pilot import Pilot
from gradysim.sitl.vehicle import Vehicle, position_of, prepare

_logger = logging.getLogger(__name__)

_SILENCE_S = 10.0
"""Wall time without a position after which an autopilot has failed."""

_FARTHEST_START_M = 10_000.0
"""Largest distance of a real vehicle from its initial position."""

_CLOCK_OFF_S = 1.0
"""Clock error of an autopilot (simulated time) above which a warning is logged."""

_HEARTBEAT_S = 1.0

_RESTORE_S = 1.0
"""Wall time between two requests for positions, in case a ground station has changed their rate."""


class Flight:
    """One node and its autopilot: connects it, flies it to its start and counts for the report."""

    def __init__(
        self,
        node: Node[Any],
        event_loop: EventLoop,
        configuration: ArdupilotMobilityConfiguration,
        real_time: float,
    ) -> None:
        """Create a flight. `real_time` is simulated seconds per second of wall time, > 0."""
        self.report = NodeReport()
        self._node = node
        self._event_loop = event_loop
        self._configuration = configuration
        self._real_time = real_time
        self._position_hz = max(configuration.mavlink_streamrate, 1 / configuration.update_rate)
        self._reference: Position = configuration.reference_coordinates
        self._start = home_of(self._reference, node.position)
        self._link = MavlinkLink(f"node {node.id} ({label_node(node)})")
        self._link.on_message = self._note
        self._vehicle = Vehicle(self._link)
        self.pilot = Pilot(
            self._vehicle, self._coordinates_of, node.position, configuration.default_speed, real_time
        )
        self._connection: Connection | None = None
        self._ground_station: GroundStationPort | None = None
        self._heartbeats: asyncio.Task[None] | None = None
        self._has_begun = False
        self._is_fresh = False
        self._is_awaited = False
        self._silent_s = 0.0
        self._clock_offset_s: float | None = None

    async def prepare(self, fleet: Fleet | None) -> None:
        """Take off and fly to the initial position. Without a fleet, use a running vehicle."""
        configuration = self._configuration
        timeout_s = configuration.uav_api_startup_timeout
        vehicle = self._vehicle
        initial = self._node.position
        if fleet is not None:
            check_start(vehicle.name, initial, self._reference)
        await self._connect(fleet, timeout_s)
        is_simulated = fleet is not None
        await prepare(
            vehicle,
            self._coordinates_of(initial),
            position_hz=self._position_hz,
            speed_mps=configuration.default_speed,
            timeout_s=timeout_s,
            parameters=(configuration.autopilot_parameters or {}) if is_simulated else {},
            check=lambda: None if is_simulated else self._check_distance(initial),
        )
        _logger.debug("%s is at its initial position", vehicle.name)

    async def begin(self, *, is_simulated: bool) -> None:
        """Set the autopilot's clock rate to that of the simulation, and record the state at t = 0."""
        if is_simulated:
            await self._vehicle.set_parameter("SIM_SPEEDUP", self._real_time)
        self._note_position(self._link.latest["GLOBAL_POSITION_INT"])
        self._has_begun = True
        self.report.battery_start = self._vehicle.battery_percent

    async def attend(self) -> None:
        """Keep the vehicle flying until canceled. Raise SitlError if it ends or ignores commands."""
        await asyncio.gather(self.pilot.watch(), self.pilot.attend(), self._keep_positions_coming())

    def telemetry_is_due(self) -> None:
        """Deliver the position if it is new; otherwise when it arrives, if that is before the next telemetry.

        Raise SitlError if there was no position for a long time.
        """
        configuration = self._configuration
        self.report.requests += 1
        self._note_clock()
        if self._is_awaited:
            self.report.drops += 1
            self._silent_s += configuration.update_rate / self._real_time
            if self._silent_s > _SILENCE_S:
                raise SitlError(f"{self._link.name}: no position for {_SILENCE_S:g} s of wall time")
        self._is_awaited = not self._is_fresh
        if self._is_fresh:
            self._deliver()

    def end(self) -> None:
        """Record the state at the end, and warn if the clock differed from simulated time."""
        self.report.battery_end = self._vehicle.battery_percent
        error_s = self.report.clock_error_s
        if abs(error_s) > _CLOCK_OFF_S:
            side = "behind" if error_s < 0 else "ahead of"
            _logger.warning(
                "%s: the autopilot's clock was up to %.1f s %s simulated time; a smaller real_time may help",
                self._link.name,
                abs(error_s),
                side,
            )

    def close(self) -> None:
        """Close the connections. Do nothing if they are closed."""
        for part in (self._ground_station, self._connection):
            if part is not None:
                part.close()
        if self._heartbeats is not None:
            self._heartbeats.cancel()

    async def _connect(self, fleet: Fleet | None, timeout_s: float) -> None:
        configuration = self._configuration
        if configuration.ground_station_ip is not None:
            self._ground_station = await open_ground_station(self._link, configuration.ground_station_ip)
        if fleet is not None:
            self._connection = await fleet.launch(
                self._link,
                self._node.id,
                self._start,
                speedup=configuration.simulation_startup_speedup,
                timeout_s=timeout_s,
                parameters=configuration.autopilot_parameters,
            )
        else:
            address = (configuration.vehicle_addresses or {})[self._node.id]
            self._connection = await connect(self._link, address, timeout_s)
            self._heartbeats = asyncio.create_task(self._send_heartbeats())

    async def _send_heartbeats(self) -> None:
        """Send heartbeats, so that a real vehicle does not consider its link lost, and starts to answer."""
        while self._link.lost is None:
            self._vehicle.send_heartbeat()
            await asyncio.sleep(_HEARTBEAT_S)

    async def _keep_positions_coming(self) -> None:
        """Restore the rate of positions, which a ground station on the same connection may change."""
        while self._ground_station is not None:
            await asyncio.sleep(_RESTORE_S)
            self._vehicle.restore_stream(self._position_hz)

    def _coordinates_of(self, point: Position) -> Position:
        """Return (latitude deg, longitude deg, height above home m) of a point of the frame."""
        latitude, longitude, _ = cartesian_to_geo(self._reference, point)
        check_same_hemisphere(self._start, longitude)
        return (latitude, longitude, point[2])

    def _check_distance(self, initial: Position) -> None:
        coordinates = self._vehicle.position
        if coordinates is None:
            raise SitlError(f"{self._link.name}: no position: it does not send GLOBAL_POSITION_INT")
        distance_m = math.dist(initial[:2], geo_to_cartesian(self._reference, coordinates)[:2])
        if distance_m > _FARTHEST_START_M:
            raise SitlError(
                f"{self._link.name}: it is at latitude {coordinates[0]:.5f}, longitude {coordinates[1]:.5f}, "
                f"{distance_m / 1000:.0f} km from its initial position: check reference_coordinates"
            )

    def _note(self, message: Message) -> None:
        """Handle a message of the autopilot."""
        kind = message.get_type()
        if kind == "STATUSTEXT":
            level = logging.INFO if self._configuration.uav_api_log_console else logging.DEBUG
            _logger.log(level, "%s says: %s", self._link.name, message.text)
        elif kind == "GLOBAL_POSITION_INT" and self._has_begun:
            self._note_position(message)
            if self._is_awaited:
                self._is_awaited = False
                self._deliver()

    def _note_position(self, message: Message) -> None:
        latitude, longitude, height_m = position_of(message)
        # Heights count from home, so a vehicle with a wrong altitude does not dive.
        coordinates = (latitude, longitude, self._reference[2] + height_m)
        self._node.position = geo_to_cartesian(self._reference, coordinates)
        self._is_fresh = True
        self._silent_s = 0.0

    def _deliver(self) -> None:
        self._is_fresh = False
        node = self._node

        def deliver() -> None:
            node.protocol_encapsulator.handle_telemetry(Telemetry(node.position))

        self._event_loop.schedule_event(
            self._event_loop.current_time, deliver, context_of(node, "handle_telemetry")
        )

    def _note_clock(self) -> None:
        message = self._link.latest.get("GLOBAL_POSITION_INT")
        if message is None:
            return
        ahead_s = message.time_boot_ms / 1000 - self._event_loop.current_time
        if self._clock_offset_s is None:
            self._clock_offset_s = ahead_s
        self.report.clock_error_s = max(self.report.clock_error_s, ahead_s - self._clock_offset_s, key=abs)


class FreeRunning:
    """All vehicles of a simulation in real time. They do not wait for it."""

    def __init__(
        self,
        nodes: Mapping[int, Node[Any]],
        configuration: ArdupilotMobilityConfiguration,
        event_loop: EventLoop,
        asyncio_loop: asyncio.AbstractEventLoop,
        real_time: float,
    ) -> None:
        """Create the vehicles. `real_time` is simulated seconds per second of wall time, > 0."""
        self._configuration = configuration
        self._event_loop = event_loop
        self._asyncio_loop = asyncio_loop
        self._real_time = real_time
        self._fleet: Fleet | None = None
        self._nodes = nodes
        self._flights: dict[int, Flight] = {}
        self._tasks: list[asyncio.Task[None]] = []
        self._times = UpdateTimes(configuration.update_rate, event_loop.current_time)
        self._updates = 0

    def begin(self) -> None:
        """Start the autopilots and fly all nodes to their initial positions, together."""
        configuration, loop = self._configuration, self._asyncio_loop
        self._tasks.append(loop.create_task(self._close_at_the_end()))
        if configuration.simulate_drones and self._nodes:
            self._fleet = Fleet(
                configuration.ardupilot_path,
                user=configuration.autopilot_user,
                console_folder=configuration.uav_api_log_path,
            )
        for identifier, node in self._nodes.items():
            self._flights[identifier] = Flight(node, self._event_loop, configuration, self._real_time)
        _run(loop, self._take_off())
        for flight in self._flights.values():
            task = loop.create_task(flight.attend())
            task.add_done_callback(_raise_failure)
            self._tasks.append(task)
        self._event_loop.schedule_event(self._event_loop.current_time, self._update, "ArduPilot")

    def handle_command(self, command: MobilityCommand, node: Node[Any]) -> None:
        """Let the autopilot of a node carry out a command. Raise as `give_order`."""
        reference = self._configuration.reference_coordinates
        give_order(command, node.id, reference, self._flights[node.id].pilot)

    def end(self) -> Mapping[int, NodeReport]:
        """Return the reports. Real vehicles stay in the air."""
        for flight in self._flights.values():
            flight.end()
        if not self._configuration.simulate_drones:
            _logger.warning(
                "The simulation has ended. Its vehicles are in the air and hold their position, "
                "unless a failsafe takes over"
            )
        return {identifier: flight.report for identifier, flight in self._flights.items()}

    def close(self) -> None:
        """End the autopilots and close the connections."""
        for flight in self._flights.values():
            flight.close()
        for task in self._tasks:
            task.cancel()
        self._tasks = []
        if self._fleet is not None:
            self._fleet.close()
            self._fleet = None

    async def _take_off(self) -> None:
        await _all(flight.prepare(self._fleet) for flight in self._flights.values())
        is_simulated = self._fleet is not None
        await _all(flight.begin(is_simulated=is_simulated) for flight in self._flights.values())

    async def _close_at_the_end(self) -> None:
        """Close all when the tasks are canceled, as for a simulation that is not finished."""
        try:
            await asyncio.Event().wait()
        finally:
            self.close()

    def _update(self) -> None:
        for flight in self._flights.values():
            flight.telemetry_is_due()
        self._updates += 1
        self._event_loop.schedule_event(self._times.time_of(self._updates), self._update, "ArduPilot")


def _run(loop: asyncio.AbstractEventLoop, work: Coroutine[Any, Any, None]) -> None:
    """Run a coroutine to its end. On Ctrl-C cancel it and let it clean up."""
    task = loop.create_task(work)
    with outer_loop_stands():
        try:
            loop.run_until_complete(task)
        except KeyboardInterrupt:
            task.cancel()
            with contextlib.suppress(KeyboardInterrupt, asyncio.CancelledError, SitlError):
                loop.run_until_complete(task)
            raise


async def _all(steps: Iterable[Coroutine[Any, Any, None]]) -> None:
    """Run all at the same time. If one fails, cancel the others and raise its exception."""
    tasks = [asyncio.ensure_future(step) for step in steps]
    try:
        await asyncio.gather(*tasks)
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)


def _raise_failure(task: asyncio.Task[None]) -> None:
    """Raise the exception of a task, so that it ends the simulation."""
    if not task.cancelled():
        task.result()
