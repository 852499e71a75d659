"""One node and its autopilot, from the autopilot's start to its end."""

import asyncio
import logging
import math
from typing import Any

from gradysim.encapsulator.flight_orders import give_order
from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.position import Position, geo_to_cartesian
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.ardupilot_mobility.configuration import ArdupilotMobilityConfiguration
from gradysim.simulator.handler.ardupilot_mobility.report import NodeReport
from gradysim.simulator.log import label_node
from gradysim.simulator.node import Node
from gradysim.sitl.connection import Connection, connect
from gradysim.sitl.error import SitlError
from gradysim.sitl.fleet import Fleet
from gradysim.sitl.flown_node import check_start
from gradysim.sitl.frame import cartesian_to_geo, check_same_hemisphere, home_of
from gradysim.sitl.ground_station import GroundStationPort, open_ground_station
from gradysim.sitl.link import MavlinkLink, Message
from gradysim.sitl.pilot import Pilot
from gradysim.sitl.preparation import prepare
from gradysim.sitl.vehicle import Vehicle, position_of

_logger = logging.getLogger(__name__)

_SILENCE_S = 10.0
"""Wall time without any position after which an autopilot is given up."""

_FARTHEST_START_M = 10_000.0
"""A real vehicle that is farther from its initial position than this has been given a wrong one."""

_CLOCK_OFF_S = 1.0
"""Simulated time by which an autopilot's clock may be off before somebody ought to know."""

_HELLO_S = 1.0

_RESTORE_S = 1.0
"""Wall time after which positions come as often as they should again, whatever a ground station asked for."""


class Flight:
    """Starts or finds one node's autopilot, flies it to its place and then does what the protocol wants.

    Attributes:
        report: What is told of the node at the end.
    """

    def __init__(
        self,
        node: Node[Any],
        event_loop: EventLoop,
        configuration: ArdupilotMobilityConfiguration,
        real_time: float,
    ) -> None:
        """Prepare for a node; `real_time` is simulated seconds for each wall second, > 0."""
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
        self._pilot = Pilot(
            self._vehicle, self._place_of, node.position, configuration.default_speed, real_time
        )
        self._connection: Connection | None = None
        self._ground_station: GroundStationPort | None = None
        self._hello: asyncio.Task[None] | None = None
        self._has_begun = False
        self._is_fresh = False
        self._is_awaited = False
        self._silent_s = 0.0
        self._clock_offset_s: float | None = None

    async def prepare(self, fleet: Fleet | None) -> None:
        """Take off and fly to the initial position; without a fleet, with a vehicle that is there already.

        Raises:
            SitlError: A step failed.
        """
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
            self._place_of(initial),
            position_hz=self._position_hz,
            speed_mps=configuration.default_speed,
            timeout_s=timeout_s,
            parameters=(configuration.autopilot_parameters or {}) if is_simulated else {},
            check=lambda: None if is_simulated else self._check_distance(initial),
        )
        _logger.debug("%s is at its initial position", vehicle.name)

    async def begin(self, *, is_simulated: bool) -> None:
        """Have the autopilot's clock run like the simulation's, and note the state at t = 0."""
        if is_simulated:
            await self._vehicle.set_parameter("SIM_SPEEDUP", self._real_time)
        self._note_position(self._link.latest["GLOBAL_POSITION_INT"])
        self._has_begun = True
        self.report.battery_start = self._vehicle.battery_percent

    async def attend(self) -> None:
        """Keep the vehicle flying, for ever. SitlError as soon as it is gone or does not obey any more."""
        await asyncio.gather(self._pilot.watch(), self._pilot.attend(), self._keep_positions_coming())

    def obey(self, command: MobilityCommand) -> None:
        """Carry out a command of the protocol; raises as `give_order`, and SitlError if it is gone."""
        give_order(command, self._node.id, self._reference, self._pilot)

    def telemetry_is_due(self) -> None:
        """Deliver the position if it is new; otherwise as soon as it comes, if that is before the next time.

        Raises:
            SitlError: No position has come for long.
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
        """Note the state at the end, and warn of a flight that was not at the simulation's pace."""
        self.report.battery_end = self._vehicle.battery_percent
        error_s = self.report.clock_error_s
        if abs(error_s) > _CLOCK_OFF_S:
            side = "behind" if error_s < 0 else "ahead of"
            _logger.warning(
                "%s: its autopilot's clock was up to %.1f s %s simulated time; a smaller real_time may help",
                self._link.name,
                abs(error_s),
                side,
            )

    def close(self) -> None:
        """Leave the vehicle; no-op if that has happened."""
        for part in (self._ground_station, self._connection):
            if part is not None:
                part.close()
        if self._hello is not None:
            self._hello.cancel()

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
            self._hello = asyncio.create_task(self._say_hello())

    async def _say_hello(self) -> None:
        """Keep a real vehicle from taking its link for lost; this may also be what makes it answer."""
        while self._link.lost is None:
            self._vehicle.say_hello()
            await asyncio.sleep(_HELLO_S)

    async def _keep_positions_coming(self) -> None:
        """Undo what a ground station, which speaks by the same connection, makes of their rate."""
        while self._ground_station is not None:
            await asyncio.sleep(_RESTORE_S)
            self._vehicle.restore_stream(self._position_hz)

    def _place_of(self, point: Position) -> Position:
        """Return (latitude deg, longitude deg, height above home m) of a point of the frame."""
        latitude, longitude, _ = cartesian_to_geo(self._reference, point)
        check_same_hemisphere(self._start, longitude)
        return (latitude, longitude, point[2])

    def _check_distance(self, initial: Position) -> None:
        place = self._vehicle.position
        if place is None:
            raise SitlError(f"{self._link.name}: no position: it sends no GLOBAL_POSITION_INT")
        distance_m = math.dist(initial[:2], geo_to_cartesian(self._reference, place)[:2])
        if distance_m > _FARTHEST_START_M:
            raise SitlError(
                f"{self._link.name}: it is at latitude {place[0]:.5f}, longitude {place[1]:.5f}, "
                f"{distance_m / 1000:.0f} km from its initial position: check reference_coordinates"
            )

    def _note(self, message: Message) -> None:
        """Take a message of the autopilot."""
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
        # Heights count from home, wherever that is: who is wrong about its altitude does not dive.
        place = (latitude, longitude, self._reference[2] + height_m)
        self._node.position = geo_to_cartesian(self._reference, place)
        self._is_fresh = True
        self._silent_s = 0.0

    def _deliver(self) -> None:
        self._is_fresh = False
        node = self._node

        def deliver() -> None:
            node.protocol_encapsulator.handle_telemetry(Telemetry(node.position))

        self._event_loop.schedule_event(
            self._event_loop.current_time, deliver, f"{label_node(node)} handle_telemetry"
        )

    def _note_clock(self) -> None:
        message = self._link.latest.get("GLOBAL_POSITION_INT")
        if message is None:
            return
        ahead_s = message.time_boot_ms / 1000 - self._event_loop.current_time
        if self._clock_offset_s is None:
            self._clock_offset_s = ahead_s
        self.report.clock_error_s = max(self.report.clock_error_s, ahead_s - self._clock_offset_s, key=abs)
