"""One simulation of prototype mode: nodes and handlers, and the run of their events."""

import logging
import math
import random
import threading
import time
import weakref
from collections.abc import Callable, Iterable, Mapping
from datetime import timedelta
from pathlib import Path
from types import MappingProxyType
from typing import Any

from gradysim.encapsulator.python import PythonEncapsulator
from gradysim.protocol.checked_values import checked_point
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.position import Position
from gradysim.simulator.configuration import SimulationConfiguration
from gradysim.simulator.event import EventLoop
from gradysim.simulator.handler.interface import IAsyncNodeHandler, INodeHandler
from gradysim.simulator.handler.registry import (
    finalize_after_failure,
    step_hooks,
    stop_judging,
)
from gradysim.simulator.log import SimulationFormatter, context_of, setup_simulation_formatter
from gradysim.simulator.node import Node
from gradysim.simulator.pacing import AsyncioRunner, Pacing, WakingEventLoop
from gradysim.simulator.profiling import EventProfile, TimingReport
from gradysim.simulator.real_time import RealTimePacer, is_full_speed, real_time_factor
from gradysim.simulator.validation import checked_protocol_class

_logger = logging.getLogger(__name__)

# Events between two checks of whether the simulation is over.
_CHUNK = 1 << 20


class Simulator:
    """One simulation, made by `gradysim.simulator.simulation.SimulationBuilder.build`.

    `start_simulation` runs it to its end. `step_simulation` and `run_events` run a part of it; call
    `finalize` to stop before the end. An exception of a protocol or a handler ends the simulation.

    Attributes:
        seed: Seed of all random numbers of the run.
        writes_log: Whether it writes log lines itself, as its configuration says.
        prepare_node: Called with each node, if it is set, after its provider and before its protocol is made.
        ids_by_name: Ids of the nodes that have a name; set it before they are made.
    """

    seed: int
    writes_log = True
    prepare_node: Callable[[Node[Any]], None] | None = None
    ids_by_name: Mapping[str, int] = MappingProxyType({})

    def __init__(self, handlers: Mapping[str, INodeHandler], configuration: SimulationConfiguration) -> None:
        """Make a simulation without nodes. ValueError if a value of the configuration is out of range."""
        configuration.validate()
        self._configuration = configuration
        # A script that seeds Python's stream gets the same run again.
        self.seed = random.getrandbits(32) if configuration.seed is None else configuration.seed
        self._handlers = dict(handlers)
        asynchronous = [
            handler for handler in self._handlers.values() if isinstance(handler, IAsyncNodeHandler)
        ]
        self._asyncio_runner = AsyncioRunner() if asynchronous else None
        self._event_loop = (
            EventLoop() if self._asyncio_runner is None else WakingEventLoop(self._asyncio_runner)
        )
        self._nodes: dict[int, Node[Any]] = {}
        self._iteration = 0
        self._initialized = False
        self._finalized = False
        self._start_wall_s = 0.0
        self._formatter = SimulationFormatter()
        # They clean up after a simulation that is dropped before its end.
        self._guards: list[weakref.finalize[[], Simulator]] = []
        # Handlers to finalize, and nodes to finish.
        self._live_handlers: list[INodeHandler] = []
        self._live_nodes: list[Node[Any]] = []
        self._pacing: Pacing | None = None
        self._report: TimingReport | None = None
        self._profile = EventProfile() if configuration.profile else None
        self._step_hooks = step_hooks(self._handlers.values())
        self._until_s = math.inf if configuration.duration is None else configuration.duration
        if self._asyncio_runner is not None:
            self._guards.append(weakref.finalize(self, self._asyncio_runner.close))
        for handler in self._handlers.values():
            handler.inject(self._event_loop)
            if self._asyncio_runner is not None and isinstance(handler, IAsyncNodeHandler):
                handler.inject_async(self._asyncio_runner.asyncio_loop, self._real_time_factor())

    @property
    def current_time(self) -> float:
        """Simulated time in seconds."""
        return self._event_loop.current_time

    @property
    def iteration(self) -> int:
        """Number of events that ran so far."""
        return self._iteration

    @property
    def nodes(self) -> tuple[Node[Any], ...]:
        """All nodes, in the order of creation."""
        return tuple(self._nodes.values())

    @property
    def active_node(self) -> int | None:
        """Id of the node that the event under way calls; None if there is none."""
        formatter = self._formatter
        return None if formatter.iteration is None else getattr(formatter.context, "node_id", None)

    def create_node(self, position: Position, protocol: type[IProtocol], identifier: int) -> Node[Any]:
        """Make a node at (x, y, z) in meters with a protocol of this class. Register it with every handler.

        Raise ValueError if another node has this identifier, or the position is not finite.
        """
        if identifier in self._nodes:
            raise ValueError(f"there is a node with the id {identifier!r} already")
        node: Node[Any] = Node()
        node.id = identifier
        node.position = checked_point("the position of a node", position, ValueError)
        node.seed = self.seed
        node.ids_by_name = self.ids_by_name
        node.protocol_encapsulator = PythonEncapsulator(node, **self._handlers)
        node.protocol_encapsulator.provider.initial_position = node.position
        if self.prepare_node is not None:
            self.prepare_node(node)
        node.protocol_encapsulator.encapsulate(checked_protocol_class(protocol))
        self._nodes[identifier] = node
        for handler in self._handlers.values():
            handler.register_node(node)
        return node

    def get_node(self, identifier: int) -> Node[Any]:
        """Return the node with that id; KeyError if there is none."""
        try:
            return self._nodes[identifier]
        except KeyError:
            raise KeyError(f"there is no node {identifier!r}, only {sorted(self._nodes)}") from None

    def scope_event(self, iteration: int, timestamp: float, context: str) -> None:
        """Show event `iteration` at `timestamp` (s) in the log lines from now on."""
        self._formatter.clock = lambda: timestamp
        self._formatter.scope_event(iteration, context)

    def step_simulation(self) -> bool:
        """Run one event, and initialize before the first one. Return False when it was the last one."""
        return self.run_events(1)

    def run_until(self, time_s: float, max_events: int) -> bool:
        """Run the events up to a simulated time, those at that time included, at most `max_events`.

        Return whether that time is reached, or the simulation has ended.
        """
        if not self.run_events(max_events, time_s):
            return True
        next_time = self._event_loop.next_time()
        if next_time is None or next_time <= time_s:
            return False
        self._event_loop.advance_to(time_s)
        return True

    def run_events(self, count: int, until_s: float = math.inf) -> bool:
        """Run at most `count` events up to the simulated time `until_s`. Initialize before the first one.

        Return whether the simulation continues. Otherwise it has been finalized.
        """
        if self._finalized:
            return False
        until_s = min(until_s, self._until_s)
        try:
            if not self._initialized:
                self._initialize_simulation()
            self._formatter.thread = threading.get_ident()
            if count == 1 and self._pacing is None and self._profile is None:
                self._execute_next(until_s)
            else:
                self._execute(count, until_s)
            done = self.is_simulation_done()
        except KeyboardInterrupt:
            raise  # not a failure: the caller may continue or finalize
        except BaseException:
            self._finalized = True  # without `finish`, since the state is unknown
            self._release()
            raise
        finally:
            self._formatter.thread = None
        if done:
            self.finalize()
        return not done

    def start_simulation(self) -> None:
        """Run the simulation to its end.

        On KeyboardInterrupt, `finish` of the protocols is called before it is raised again.
        """
        try:
            while self.run_events(_CHUNK):
                pass
        except KeyboardInterrupt:
            self.finalize(complete=False)
            raise

    def is_simulation_done(self) -> bool:
        """Return whether no event is left within `duration`, or `max_iterations` events have run."""
        if self._finalized:
            return True
        if not self._initialized:
            return False
        limit = self._configuration.max_iterations
        if limit is not None and self._iteration >= limit:
            return True
        next_time = self._event_loop.next_time()
        return next_time is None or next_time > self._until_s

    def finalize(self, *, complete: bool = True) -> None:
        """End the simulation: call `finish` of the protocols, then `finalize` of the handlers.

        No-op if the simulation has ended. If `duration` ended it, the time becomes `duration`. Assertions of
        a simulation that is not `complete` are not checked.
        """
        if self._finalized:
            return
        if not complete:
            stop_judging(self._live_handlers)
        next_time = self._event_loop.next_time()
        if self._initialized and next_time is not None and next_time > self._until_s:
            self._event_loop.advance_to(self._until_s)
        self._finalized = True
        try:
            if self._initialized:
                self._formatter.thread = threading.get_ident()
                self._finish()
        finally:
            self._release()

    def _finish(self) -> None:
        for node in self._live_nodes:
            self._formatter.scope_event(self._iteration, context_of(node, "Finalization"))
            node.protocol_encapsulator.finish()
        self._formatter.clear_iteration()
        while self._live_handlers:
            self._live_handlers.pop(0).finalize()
        self._log_end()

    # Private names of 0.8 that scripts use, such as environments of reinforcement learning.
    @property
    def _current_timestamp(self) -> float:
        return self.current_time

    def _finalize_simulation(self) -> None:
        self.finalize()

    def _initialize_simulation(self) -> None:
        self._initialized = True
        loop = self._event_loop
        configuration = self._configuration
        if self.writes_log:
            self._formatter = setup_simulation_formatter(
                configuration.debug,
                configuration.log_file,
                quiet=not configuration.execution_logging,
                clock=lambda: loop.current_time,
            )
            self._guards.append(weakref.finalize(self, self._formatter.remove))
        self._formatter.thread = threading.get_ident()
        random.seed(self.seed)
        self._start_wall_s = time.monotonic()
        for handler in self._handlers.values():
            self._live_handlers.append(handler)
            handler.initialize()
        for node in self._nodes.values():
            self._formatter.scope_event(0, context_of(node, "Initialization"))
            node.protocol_encapsulator.initialize()
            self._live_nodes.append(node)
        self._formatter.clear_iteration()
        _logger.info("[--------- Simulation started ---------]")
        self._pacing = self._make_pacing()

    def _make_pacing(self) -> Pacing | None:
        """Return what waits between events; None at full speed without asyncio."""
        factor = self._real_time_factor()
        if factor == 0 and self._asyncio_runner is None:
            return None
        if factor != 0 and self._configuration.timing_report:
            self._report = TimingReport(Path("timing_report.csv"), factor)
            self._guards.append(weakref.finalize(self, self._report.close))
        handlers = list(self._handlers.values())
        return Pacing(
            self._event_loop,
            self._until_s,
            pacer=RealTimePacer(factor) if factor != 0 else None,
            asyncio_runner=self._asyncio_runner,
            report=self._report,
            paused_s=lambda: sum(getattr(handler, "paused_s", 0.0) for handler in handlers),
        )

    def _real_time_factor(self) -> float:
        return 0.0 if is_full_speed() else real_time_factor(self._configuration.real_time)

    def _execute(self, count: int, until_s: float) -> None:
        limit = self._configuration.max_iterations
        first = self._iteration
        last = first + count if limit is None else min(first + count, limit)
        loop = self._event_loop
        formatter = self._formatter
        hooks = self._step_hooks
        profile = self._profile
        iterations: Iterable[int] = range(first, last)
        if self._pacing is not None:
            iterations = self._pacing.before_each(iterations)
        # zip takes the number before the event. So pacing waits before an event is taken, and when the
        # numbers end, no event is taken.
        for iteration, event in zip(iterations, loop.take_events(until_s), strict=False):
            formatter.iteration = iteration
            formatter.context = event[1]
            if profile is None:
                event[0]()
            else:
                profile.run(event)
            for hook in hooks:
                hook(iteration, loop.current_time)
            self._iteration = iteration + 1
        formatter.iteration = None

    def _execute_next(self, until_s: float) -> None:
        """Run one event, faster than `_execute`: learning environments step through all events."""
        iteration = self._iteration
        limit = self._configuration.max_iterations
        if limit is not None and iteration >= limit:
            return
        loop = self._event_loop
        event = loop.take_event(until_s)
        if event is None:
            return
        formatter = self._formatter
        formatter.iteration = iteration
        formatter.context = event[1]
        event[0]()
        for hook in self._step_hooks:
            hook(iteration, loop.current_time)
        self._iteration = iteration + 1
        formatter.iteration = None

    def _log_end(self) -> None:
        if self._profile is not None:
            self._profile.report()
        if self._report is not None:
            self._report.log_summary()
        _logger.info("[--------- Simulation finished ---------]")
        _logger.info(
            "Real time elapsed: %s\tTotal iterations: %s\tSimulation time: %s",
            timedelta(seconds=time.monotonic() - self._start_wall_s),
            self._iteration,
            timedelta(seconds=self.current_time),
        )

    def _release(self) -> None:
        """Clean up. Handlers are left to finalize only after a failure, which must not be hidden."""
        finalize_after_failure(self._live_handlers)
        self._formatter.clear_iteration()
        self._formatter.thread = None
        while self._guards:
            self._guards.pop(0)()
