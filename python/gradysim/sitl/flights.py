"""All vehicles of a simulation that autopilots fly on simulated time: as fast as possible, and repeatable."""

import asyncio
import logging
import math
import os
from collections.abc import Callable, Collection, Coroutine, Iterable, Mapping
from typing import Any

from gradysim.motion.quadcopter import HOVER_THRUST, THRUST_EXPO, Quadcopter
from gradysim.protocol.defaults import UPDATE_S
from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.protocol.position import Position
from gradysim.sitl.autopilot_node import AutopilotNode, check_start, ground_temperature, wind_mps
from gradysim.sitl.fleet import Fleet
from gradysim.sitl.flight_orders import give_order
from gradysim.sitl.frame import autopilots_coordinates, home_of
from gradysim.sitl.lock_step import RATE_HZ, LockStepAutopilot, LockStepGroup, VehicleClockLoop
from gradysim.sitl.mavlink import MavlinkLink, Message
from gradysim.sitl.pilot import Pilot
from gradysim.sitl.vehicle import Vehicle, prepare

_POSITIONS_HZ = 5.0
"""Rate of position messages. It decides how precisely an arrival is detected."""

_SETTLED_M, _SETTLED_MPS = 0.2, 0.1
"""Largest position error and speed of a vehicle that hovers at its start."""

_PARAMETERS: Mapping[str, float] = {
    "SIM_RATE_HZ": RATE_HZ,
    "MOT_THST_EXPO": THRUST_EXPO,
    "MOT_THST_HOVER": HOVER_THRUST,
}
"""ArduCopter parameters that match the simulated vehicle."""


class LockStepFlight:
    """Flight of one node: its autopilot, its vehicle, and the pilot that takes commands after `prepare`."""

    def __init__(
        self, node: AutopilotNode, reference: Position, on_text: Callable[[str, str], None] | None
    ) -> None:
        """Open the ports. `reference` and `on_text` are those of `Flights`."""
        self.name = node.name
        self._node = node
        self._home = home_of(reference, node.start)
        self._on_text = on_text
        self._link = MavlinkLink(node.name)
        self._link.on_message = self._note
        body = Quadcopter(wind_mps(node.name, node.parameters), node.drag_kgps)
        self.autopilot = LockStepAutopilot(self._link, body, node.wind)
        self.vehicle = Vehicle(self._link)
        self.pilot = Pilot(self.vehicle, self._coordinates_of, node.start, node.speed_mps)

    @property
    def position(self) -> Position:
        """Position of the node (x, y, z) in meters."""
        north, east, down = self.autopilot.body.position_m
        x, y, _ = self._node.start
        return (x + north, y + east, 0.0 - down)

    @property
    def is_settled(self) -> bool:
        """Whether the vehicle hovers at its start."""
        off_m = math.dist(self.position, self._node.start)
        return off_m <= _SETTLED_M and math.hypot(*self.autopilot.body.velocity_mps) <= _SETTLED_MPS

    def start(self, fleet: Fleet, timeout_s: float) -> None:
        """Start the autopilot and wait until it waits for its first step."""
        process = fleet.start(
            self._node.name,
            self._node.id,
            self._home,
            mavlink_port=self.autopilot.mavlink_port,
            physics_port=self.autopilot.port,
            parameters={**_PARAMETERS, **ground_temperature(self._home[2]), **self._node.parameters},
        )
        self.autopilot.meet(process, timeout_s)

    async def prepare(self, timeout_s: float) -> None:
        """Take off and fly to the start. Raise SitlError if a step fails or exceeds `timeout_s`."""
        await prepare(
            self.vehicle,
            self._coordinates_of(self._node.start),
            position_hz=_POSITIONS_HZ,
            speed_mps=self._node.speed_mps,
            timeout_s=timeout_s,
            parameters=self._node.parameters,
        )

    def _coordinates_of(self, point: Position) -> Position:
        x, y, _ = self._node.start
        return autopilots_coordinates(self._home, (point[0] - x, point[1] - y, point[2]))

    def _note(self, message: Message) -> None:
        if self._on_text is not None and message.get_type() == "STATUSTEXT":
            self._on_text(self._node.name, message.text)


_logger = logging.getLogger(__name__)

_TURN_S = 0.05
"""Longest time between two turns of the asyncio loop. There is also one after each message."""

_SETTLED_AFTER_S = 10.0
"""Time after which vehicles should hover at their starts."""


class Flights:
    """All nodes of a simulation that autopilots fly."""

    def __init__(
        self,
        nodes: Iterable[AutopilotNode],
        reference: Position,
        *,
        on_text: Callable[[str, str], None] | None = None,
        console_folder: str | os.PathLike[str] | None = None,
        timeout_s: float = 120.0,
    ) -> None:
        """Create the flights without starting them.

        Args:
            nodes: The nodes, in the order of their ids.
            reference: (latitude deg, longitude deg, altitude m) of the origin.
            on_text: Called with the name of a node and each text of its autopilot. It must not refer to an
                object that closes the flights when it is garbage collected, or this never happens.
            console_folder: Directory for the output of each autopilot; None to discard it.
            timeout_s: Limit for each step before the start, in wall time and in vehicle time.
        """
        self._nodes = tuple(nodes)
        self._ids = frozenset(node.id for node in self._nodes)
        self._reference = reference
        self._on_text = on_text
        self._console_folder = console_folder
        self._timeout_s = timeout_s
        self._flights: dict[int, LockStepFlight] = {}
        self._fleets: dict[tuple[str | os.PathLike[str] | None, str | None], Fleet] = {}
        self._group: LockStepGroup | None = None
        self._loop: VehicleClockLoop | None = None
        self._tasks: list[asyncio.Task[None]] = []
        self._time_s = 0.0
        self._begin_s = 0.0
        self._next_turn_s = 0.0

    def begin(self) -> None:
        """Start all autopilots, take off and fly to the starts. Simulated time is 0 then.

        All are ended if this fails (SitlError) or is interrupted.
        """
        try:
            self._begin()
        except BaseException:
            self.close()
            raise

    def _begin(self) -> None:
        for node in self._nodes:
            check_start(node.name, node.start, self._reference)
        self._loop = VehicleClockLoop()
        for node in self._nodes:
            flight = self._flights[node.id] = LockStepFlight(node, self._reference, self._on_text)
            flight.start(self._fleet_of(node), self._timeout_s)
        self._group = LockStepGroup([flight.autopilot for flight in self._flights.values()])
        preparations = [self._do(flight.prepare(self._timeout_s)) for flight in self._flights.values()]
        while not all(task.done() for task in preparations):
            self._advance(self._time_s + _TURN_S)
        self._settle()
        self._begin_s = self._time_s
        for flight in self._flights.values():
            self._do(flight.pilot.watch())
            self._do(flight.pilot.attend())

    @property
    def ids(self) -> Collection[int]:
        """Ids of the nodes."""
        return self._ids

    def advance_to(self, time_s: float) -> None:
        """Fly until `time_s` of simulated time.

        Raise SitlError if an autopilot has ended, hangs, or ignores commands.
        """
        self._advance(self._begin_s + time_s)

    def position(self, node_id: int) -> Position:
        """Return the position of a node (x, y, z) in meters."""
        return self._flights[node_id].position

    def pilot(self, node_id: int) -> Pilot:
        """Return the pilot of a node. Commands reach the autopilot before its next step."""
        return self._flights[node_id].pilot

    def give_order(self, command: MobilityCommand, node_id: int) -> None:
        """Carry out a mobility command. Raise as `give_order` of `gradysim.sitl.flight_orders`."""
        give_order(command, node_id, self._reference, self.pilot(node_id))

    def battery_percent(self, node_id: int) -> float | None:
        """Return the remaining battery in percent, or None if the autopilot does not know it."""
        return self._flights[node_id].vehicle.battery_percent

    def close(self) -> None:
        """End all autopilots. Do nothing if they have ended."""
        if self._loop is not None:
            self._loop.cancel_all()
        for task in self._tasks:
            if not task.cancelled():
                task.exception()  # Only the first of several failures was raised.
        if self._group is not None:
            self._group.close()
        for flight in self._flights.values():
            flight.autopilot.close()
        for fleet in self._fleets.values():
            fleet.close()

    def _settle(self) -> None:
        """Wait until all vehicles hover at their starts, up to a limit."""
        limit_s = self._time_s + _SETTLED_AFTER_S
        while self._time_s < limit_s and not all(each.is_settled for each in self._flights.values()):
            self._advance(self._time_s + _TURN_S)
        for flight in self._flights.values():
            if not flight.is_settled:
                _logger.warning(
                    "%s: the vehicle does not hover at its start: is the wind too strong?", flight.name
                )

    def _fleet_of(self, node: AutopilotNode) -> Fleet:
        key = (node.program, node.user)
        if key not in self._fleets:
            self._fleets[key] = Fleet(
                node.program, user=node.user, console_folder=self._console_folder, grace_s=0.0
            )
        return self._fleets[key]

    def _do(self, work: Coroutine[Any, Any, None]) -> asyncio.Task[None]:
        assert self._loop is not None
        task = self._loop.create_task(work)
        self._tasks.append(task)
        return task

    def _advance(self, time_s: float) -> None:
        """Fly until `time_s` of the vehicles' clock."""
        assert self._group is not None
        if any(flight.pilot.has_new_speed for flight in self._flights.values()):
            self._turn()
        while self._time_s < time_s:
            next_s = min(time_s, self._time_s + UPDATE_S)
            heard_something = self._group.fly_to(next_s)
            self._time_s = next_s
            if heard_something or self._time_s >= self._next_turn_s:
                self._turn()

    def _turn(self) -> None:
        """Run the asyncio loop once and raise the exception of a failed task."""
        assert self._loop is not None
        self._next_turn_s = self._time_s + _TURN_S
        self._loop.turn(self._time_s)
        for task in self._tasks:
            if task.done() and not task.cancelled() and (failure := task.exception()) is not None:
                raise failure
