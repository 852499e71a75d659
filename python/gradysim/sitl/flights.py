"""All vehicles of a simulation that autopilots fly on simulated time: as fast as they go, and repeatable."""

import asyncio
import logging
import os
from collections.abc import Callable, Collection, Coroutine, Iterable
from typing import Any

from gradysim.protocol.defaults import UPDATE_S
from gradysim.protocol.position import Position
from gradysim.sitl.fleet import Fleet
from gradysim.sitl.flown_node import FlownNode, check_start
from gradysim.sitl.lock_step_flight import LockStepFlight
from gradysim.sitl.lock_step_group import LockStepGroup
from gradysim.sitl.pilot import Pilot
from gradysim.sitl.vehicle_clock import VehicleClockLoop

_logger = logging.getLogger(__name__)

_TURN_S = 0.05
"""Longest time between two turns of the clock's loop, of which there is one after each message."""

_SETTLED_AFTER_S = 10.0
"""How long vehicles may take to hover quietly at their starts."""


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
            on_text: Called with a node's name and what its autopilot says. It must not refer to an object
                that closes these when nobody refers to that any more: these would, for ever.
            console_folder: Keeps what each autopilot prints; None to throw it away.
            timeout_s: For each step before the simulation begins, wall time and that of the vehicle.
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
        """Start all autopilots, take off and fly to the starts, together; simulated time is 0 then.

        If that fails, or is interrupted, they are ended.

        Raises:
            SitlError: An autopilot cannot be started, or a step failed.
            ModuleNotFoundError: The extra `sitl` is not installed.
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
        for flight in self._flights.values():
            if not flight.is_settled:
                _logger.warning("%s: it does not hover quietly at its start: too strong a wind?", flight.name)

    def _fleet_of(self, node: FlownNode) -> Fleet:
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
        if any(flight.pilot.has_news for flight in self._flights.values()):
            self._turn()
        while self._time_s < time_s:
            next_s = min(time_s, self._time_s + UPDATE_S)
            heard_something = self._group.fly_to(next_s)
            self._time_s = next_s
            if heard_something or self._time_s >= self._next_turn_s:
                self._turn()

    def _turn(self) -> None:
        """Let all steps go on that can; raise what went wrong in one."""
        assert self._loop is not None
        self._next_turn_s = self._time_s + _TURN_S
        self._loop.turn(self._time_s)
        for task in self._tasks:
            if task.done() and not task.cancelled() and (failure := task.exception()) is not None:
                raise failure
