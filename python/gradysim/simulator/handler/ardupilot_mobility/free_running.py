"""Autopilots on the wall's time, simulated or real ones, beside a simulation that keeps to it."""

import asyncio
import contextlib
import logging
from collections.abc import Coroutine, Iterable, Mapping
from typing import Any

from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.ardupilot_mobility.configuration import ArdupilotMobilityConfiguration
from gradysim.simulator.handler.ardupilot_mobility.exception import ArdupilotMobilityException
from gradysim.simulator.handler.ardupilot_mobility.flight import Flight
from gradysim.simulator.handler.ardupilot_mobility.report import NodeReport
from gradysim.simulator.handler.mobility.updates import UpdateTimes
from gradysim.simulator.node import Node
from gradysim.sitl.error import SitlError
from gradysim.sitl.fleet import Fleet
from gradysim.sitl.nested_loop import outer_loop_stands

_logger = logging.getLogger(__name__)


class FreeRunning:
    """Vehicles that do not wait for the simulation."""

    def __init__(
        self,
        nodes: Mapping[int, Node[Any]],
        configuration: ArdupilotMobilityConfiguration,
        event_loop: EventLoop,
        asyncio_loop: asyncio.AbstractEventLoop,
        real_time: float,
    ) -> None:
        """Prepare for these nodes; `real_time` is simulated seconds for each wall second, > 0."""
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
            task = loop.create_task(self._attend(flight))
            task.add_done_callback(_pass_on)
            self._tasks.append(task)
        self._event_loop.schedule_event(self._event_loop.current_time, self._update, "ArduPilot")

    def obey(self, command: MobilityCommand, node_id: int) -> None:
        """Hand an order to a node's autopilot."""
        self._flights[node_id].obey(command)

    def end(self) -> Mapping[int, NodeReport]:
        """Return the reports; real vehicles are left in the air."""
        for flight in self._flights.values():
            flight.end()
        if not self._configuration.simulate_drones:
            _logger.warning(
                "The simulation is over; its vehicles are in the air and hold their position, "
                "unless a failsafe of theirs takes over"
            )
        return {identifier: flight.report for identifier, flight in self._flights.items()}

    def close(self) -> None:
        """End what was started."""
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
            self.close()

    def _update(self) -> None:
        try:
            for flight in self._flights.values():
                flight.telemetry_is_due()
        except SitlError as error:
            raise ArdupilotMobilityException(str(error)) from error
        self._updates += 1
        self._event_loop.schedule_event(self._times.time_of(self._updates), self._update, "ArduPilot")


def _run(loop: asyncio.AbstractEventLoop, work: Coroutine[Any, Any, None]) -> None:
    """Run to the end; Ctrl-C, which may have hit any task, leaves none of them half-done."""
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
