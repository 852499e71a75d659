"""All vehicles of a simulation that autopilots fly on simulated time: as fast as they go, and repeatable."""

import asyncio
import math
import os
from collections.abc import Callable, Collection, Coroutine, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from gradysim.protocol.position import Position
from gradysim.sitl.error import SitlError
from gradysim.sitl.fleet import Fleet
from gradysim.sitl.frame import autopilots_place, home_of
from gradysim.sitl.link import MavlinkLink, Message
from gradysim.sitl.lock_step import RATE_HZ, LockStepAutopilot
from gradysim.sitl.lock_step_group import LockStepGroup
from gradysim.sitl.pilot import Pilot
from gradysim.sitl.preparation import prepare
from gradysim.sitl.quadcopter import HOVER_THRUST, THRUST_EXPO, Quadcopter, Vector
from gradysim.sitl.vehicle import Vehicle
from gradysim.sitl.vehicle_clock import VehicleClockLoop

_POSITIONS_HZ = 5.0
"""As often an autopilot tells its position: so finely it is known when it has arrived."""

_EXCHANGE_S = 0.01
"""After so much time at most the autopilots are listened to."""

_TURN_S = 0.05
"""Longest time between two turns of the clock's loop, of which there is one after each message."""

_SETTLED_M, _SETTLED_MPS, _SETTLED_AFTER_S = 0.2, 0.1, 10.0
"""Of a vehicle that hovers where it should: how far it is off, how fast it is, how long to wait for that."""

_DEEPEST_START_M = 1.0
"""Below ground, where no vehicle arrives."""

_PARAMETERS: Mapping[str, float] = {
    "SIM_RATE_HZ": RATE_HZ,
    "MOT_THST_EXPO": THRUST_EXPO,
    "MOT_THST_HOVER": HOVER_THRUST,
}
"""Of ArduCopter, as the vehicle is."""

_SEA_LEVEL_DEGC, _LAPSE_DEGCPM = 15.0, 0.0065
"""Of the standard atmosphere (ISO 2533), in which ArduPilot's simulated barometers are."""

_GROUND_TEMPERATURE = ("GND_TEMP", "BARO_GND_TEMP")
"""Both names of the parameter, old and new; one that an autopilot does not know has no effect on it."""

_WIND = "SIM_WIND_"
_WIND_SPEED, _WIND_FROM = "SIM_WIND_SPD", "SIM_WIND_DIR"
_WIND_FROM_BY_DEFAULT_DEG = 180.0


@dataclass(frozen=True)
class FlownNode:
    """A node that an autopilot flies.

    Attributes:
        id: Of the node; its MAVLink system id is one more.
        name: For people.
        start: Where it hovers as the simulation begins: (x, y, z) in metres, not below the ground.
        speed_mps: Ground speed until it is told another, > 0.
        program: An arducopter for SITL, version 4.1 or newer; see `find_arducopter`.
        user: Whom its autopilot belongs to if root starts it; None for root.
        parameters: Of ArduCopter, by name; SIM_WIND_SPD (m/s) and SIM_WIND_DIR (deg, where it comes from) are
            the wind.
    """

    id: int
    name: str
    start: Position
    speed_mps: float = 10.0
    program: str | os.PathLike[str] | None = None
    user: str | None = "nobody"
    parameters: Mapping[str, float] = field(default_factory=dict)


class Flights:
    """All flown nodes of one simulation."""

    def __init__(
        self,
        nodes: Iterable[FlownNode],
        reference: Position,
        *,
        on_text: Callable[[str, str], None] | None = None,
        console_folder: str | os.PathLike[str] | None = None,
        timeout_s: float = 120.0,
    ) -> None:
        """Prepare; nothing is started yet.

        Args:
            nodes: In the order of their ids.
            reference: (latitude deg, longitude deg, altitude m) of the origin.
            on_text: Called with a node's name and what its autopilot says; knows nobody who closes these.
            console_folder: Keeps what each autopilot prints; None to throw it away.
            timeout_s: For each step before the simulation begins, wall time and that of the vehicle.
        """
        self._nodes = tuple(nodes)
        self._ids = frozenset(node.id for node in self._nodes)
        self._reference = reference
        self._on_text = on_text
        self._console_folder = console_folder
        self._timeout_s = timeout_s
        self._flights: dict[int, _Flight] = {}
        self._fleets: dict[tuple[str | os.PathLike[str] | None, str | None], Fleet] = {}
        self._group: LockStepGroup | None = None
        self._loop: VehicleClockLoop | None = None
        self._tasks: list[asyncio.Task[None]] = []
        self._time_s = 0.0
        self._begin_s = 0.0
        self._next_turn_s = 0.0

    def begin(self) -> None:
        """Start all autopilots, take off and fly to the starts, together; simulated time is 0 then.

        Raises:
            SitlError: An autopilot cannot be started, or a step failed.
            ModuleNotFoundError: The extra `sitl` is not installed.
        """
        for node in self._nodes:
            if node.start[2] < -_DEEPEST_START_M:
                raise SitlError(
                    f"{node.name}: its initial position is below the ground: z = {node.start[2]:g} m"
                )
        self._loop = VehicleClockLoop()
        for node in self._nodes:
            flight = self._flights[node.id] = _Flight(node, self._reference, self._on_text)
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
        """Of the nodes."""
        return self._ids

    def advance_to(self, time_s: float) -> None:
        """Fly until `time_s` of simulated time.

        Raises:
            SitlError: An autopilot is gone, hangs or does not obey any more.
        """
        self._advance(self._begin_s + time_s)

    def position(self, node_id: int) -> Position:
        """Return where a node is, (x, y, z) in metres."""
        return self._flights[node_id].position

    def pilot(self, node_id: int) -> Pilot:
        """Return who takes the orders for a node; they reach its autopilot before its next step."""
        return self._flights[node_id].pilot

    def battery_percent(self, node_id: int) -> float | None:
        """Return what is left of the battery, as far as the autopilot knows."""
        return self._flights[node_id].vehicle.battery_percent

    def close(self) -> None:
        """End all autopilots; no-op if that has happened."""
        if self._loop is not None:
            self._loop.cancel_all()
        for task in self._tasks:
            if not task.cancelled():
                task.exception()  # Only the first of several failures was passed on.
        if self._group is not None:
            self._group.close()
        for flight in self._flights.values():
            flight.autopilot.close()
        for fleet in self._fleets.values():
            fleet.close()

    def _settle(self) -> None:
        """Wait until all hover at their starts, or for as long as that may take in the wind."""
        limit_s = self._time_s + _SETTLED_AFTER_S
        while self._time_s < limit_s and not all(each.is_settled for each in self._flights.values()):
            self._advance(self._time_s + _TURN_S)

    def _fleet_of(self, node: FlownNode) -> Fleet:
        key = (node.program, node.user)
        if key not in self._fleets:
            self._fleets[key] = Fleet(node.program, user=node.user, console_folder=self._console_folder)
        return self._fleets[key]

    def _do(self, work: Coroutine[Any, Any, None]) -> asyncio.Task[None]:
        assert self._loop is not None
        task = self._loop.create_task(work)
        self._tasks.append(task)
        return task

    def _advance(self, time_s: float) -> None:
        """Fly until `time_s` of the vehicles' clock."""
        assert self._group is not None
        assert self._loop is not None
        while self._time_s < time_s:
            self._time_s = min(time_s, self._time_s + _EXCHANGE_S)
            heard_something = self._group.fly_to(self._time_s)
            if heard_something or self._time_s >= self._next_turn_s:
                self._next_turn_s = self._time_s + _TURN_S
                self._loop.turn(self._time_s)
                self._pass_on_failures()

    def _pass_on_failures(self) -> None:
        for task in self._tasks:
            if task.done() and not task.cancelled() and (failure := task.exception()) is not None:
                raise failure


class _Flight:
    """One node: its autopilot, its vehicle, its pilot."""

    def __init__(
        self, node: FlownNode, reference: Position, on_text: Callable[[str, str], None] | None
    ) -> None:
        self._node = node
        self._home = home_of(reference, node.start)
        self._on_text = on_text
        self._link = MavlinkLink(node.name)
        self._link.on_message = self._note
        self.autopilot = LockStepAutopilot(self._link, Quadcopter(wind_mps(node.name, node.parameters)))
        self.vehicle = Vehicle(self._link)
        self.pilot = Pilot(self.vehicle, self._place_of, node.speed_mps)

    @property
    def position(self) -> Position:
        north, east, down = self.autopilot.body.position_m
        x, y, _ = self._node.start
        return (x + north, y + east, -down)

    @property
    def is_settled(self) -> bool:
        """Whether it is where it should be at the start, and stays there."""
        off_m = math.dist(self.position, self._node.start)
        return off_m <= _SETTLED_M and math.hypot(*self.autopilot.body.velocity_mps) <= _SETTLED_MPS

    def start(self, fleet: Fleet, timeout_s: float) -> None:
        """Start the autopilot's program, and wait until it stands at its first step."""
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
        await prepare(
            self.vehicle,
            self._place_of(self._node.start),
            position_hz=_POSITIONS_HZ,
            speed_mps=self._node.speed_mps,
            timeout_s=timeout_s,
            parameters=self._node.parameters,
        )

    def _place_of(self, point: Position) -> Position:
        x, y, _ = self._node.start
        return autopilots_place(self._home, (point[0] - x, point[1] - y, point[2]))

    def _note(self, message: Message) -> None:
        if self._on_text is not None and message.get_type() == "STATUSTEXT":
            self._on_text(self._node.name, message.text)


def ground_temperature(altitude_m: float) -> dict[str, float]:
    """Return the parameters that tell an autopilot how warm it is where it takes off.

    It believes in 25 degC otherwise, and flies 3 % too low at sea level, and 10 % at 3000 m.
    """
    return dict.fromkeys(_GROUND_TEMPERATURE, _SEA_LEVEL_DEGC - _LAPSE_DEGCPM * altitude_m)


def wind_mps(name: str, parameters: Mapping[str, float]) -> Vector:
    """Return the velocity of the air, North, East and down, that ArduCopter's parameters of the wind mean.

    Raises:
        SitlError: One of them means nothing here: turbulence, ...; names the vehicle.
    """
    unknown = [key for key in parameters if key.startswith(_WIND) and key not in (_WIND_SPEED, _WIND_FROM)]
    if unknown:
        raise SitlError(
            f"{name}: parameter {unknown[0]}: on simulated time there are of the wind only {_WIND_SPEED} and "
            f"{_WIND_FROM}"
        )
    speed_mps = parameters.get(_WIND_SPEED, 0.0)
    heading = math.radians(parameters.get(_WIND_FROM, _WIND_FROM_BY_DEFAULT_DEG))
    return (-speed_mps * math.cos(heading), -speed_mps * math.sin(heading), 0.0)
