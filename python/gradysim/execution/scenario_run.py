"""Runs a scenario the same way in both modes, at once or step by step, and makes its result.

The simulator executes some events, then control comes back here. So a run can report progress and be stopped.
"""

import logging
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from math import inf, isnan
from time import perf_counter, process_time
from typing import Any, ClassVar, Protocol, Self

from gradysim.encapsulator.run_context import GlobalRandom, gc_paused
from gradysim.execution.run_log import RunLog
from gradysim.replay.chunk import RawChunk
from gradysim.replay.sink import OutputError, ReplaySink
from gradysim.results.recorder import recorders_of
from gradysim.results.result import Mode, NodeResult, RunResult
from gradysim.scenario.errors import did_you_mean
from gradysim.scenario.lint import Finding, RunLint
from gradysim.scenario.scenario import Scenario, require_scenario
from gradysim.scenario.schema.protocol_modules import siblings_importable

CHUNK_S = 0.05
"""Wall time that a chunk should take, in seconds."""

REPORT_INTERVAL_S = 0.1
"""Wall time between two calls of `progress`, in seconds."""

FIRST_CHUNK = 64
"""Events of the first chunk: few, as the cost of an event is not known yet."""

MAX_EVENTS = 1 << 20
"""Maximum number of events in a chunk. The chunks of a run that waits for the wall clock are short, whatever
their number of events: it would grow without bound."""


@dataclass(frozen=True)
class RunNode:
    """A node of a run.

    Attributes:
        id: Its id, 0 to n-1.
        name: Its name in the scenario, such as `uavs[2]`.
        protocol: Its protocol, or, of a native protocol, an instance of the class that shows its parameters.
        provider: What the protocol acts through: `provider.tracked_variables`, `provider.current_time()`.
    """

    id: int
    name: str
    protocol: Any
    provider: Any
    _placed: Any = field(repr=False)

    @property
    def position(self) -> tuple[float, float, float]:
        """Current position (x, y, z) in meters."""
        x, y, z = self._placed.position
        return (x, y, z)


class Recorder(Protocol):
    """Records a run for a replay."""

    def event(self, node: int, kind: int, text: str, /) -> None:
        """Record an event at a node; its kind is that of `EVENT_KINDS` by number."""

    def chunks(self, *, cut: bool, last: bool) -> Iterable[RawChunk]:
        """Return the chunks of the replay that are complete.

        With `cut`, the one that is growing ends now; with `last`, the run has ended.
        """


class ScenarioRun(ABC):
    """A scenario in one of the modes: built by the constructor, then run at once or step by step.

    `execute` runs it to its end. `run_until` and `step` run a part of it; `finish` ends it there, and so does
    the end of a `with` block. `result` returns at any time what was computed until then.

    An exception in a protocol is raised with a note of node, time and callback. It ends the run without
    `finish` of the protocols. So does an exception in a handler, such as that of an assertion that failed.
    Handlers are finalized in any case.

    A capture or replay that lacks its end raises OutputError after all else is done, or adds a note to an
    earlier exception.
    """

    mode: ClassVar[Mode]

    def __init__(
        self,
        scenario: Scenario,
        vectors_of: Iterable[int],
        replay: ReplaySink | None = None,
        log_level: int = logging.WARNING,
    ) -> None:
        """Start measuring the cost. Raises TypeError and ValueError for wrong arguments."""
        require_scenario(scenario)
        self._scenario = scenario
        self._wall_s = self._cpu_s = self._setup_s = 0.0
        self._constructed_s = (perf_counter(), process_time())
        self._advance: Callable[[float, int], bool] | None = None
        self._has_begun = self._ended = self._complete = False
        self._random = GlobalRandom(scenario.seed)
        self._lint = RunLint(scenario)
        self._recorders = recorders_of(vectors_of, len(scenario.nodes), scenario.vector_record_interval_s)
        self._replay = replay
        self._recorder: Recorder | None = None
        self._log = RunLog(log_level, scenario.nodes)
        self._protocols = {spec.protocol for spec in scenario.nodes}
        self._lacks_output = False

    @property
    def time_s(self) -> float:
        """Simulated time in seconds."""
        return self._now()

    @property
    def has_ended(self) -> bool:
        """Whether the run reached its time limit, was finished, or failed."""
        return self._ended

    @property
    def lacks_output(self) -> bool:
        """Whether a capture or a replay lacks its end."""
        return self._lacks_output

    def node(self, name: str) -> RunNode:
        """Return the node of that name, such as `groundStation` or `uavs[2]`. KeyError if there is none."""
        names = [spec.name for spec in self._scenario.nodes]
        if name not in names:
            raise KeyError(f"no node is called {name!r}{did_you_mean(name, names)}")
        index = names.index(name)
        encapsulator, placed = self._parts_of(index)
        return RunNode(index, name, encapsulator.protocol, encapsulator.provider, placed)

    def execute(
        self,
        progress: Callable[[float], None] | None = None,
        should_stop: Callable[[], bool] | None = None,
    ) -> None:
        """Run to the time limit, or until `should_stop()` returns True, then `finish` the protocols.

        `should_stop()` and `progress(time_s)` are called about ten times per second of wall time. After a
        KeyboardInterrupt, too, protocols are finished before it is raised again. Python's `random` is as
        before when this returns or raises.
        """
        with self:
            self.run_until(progress=progress, should_stop=should_stop)

    def run_until(
        self,
        time_s: float = inf,
        *,
        progress: Callable[[float], None] | None = None,
        should_stop: Callable[[], bool] | None = None,
    ) -> bool:
        """Run all events up to a simulated time, those at that time included. Return whether the run goes on.

        At the time limit of the scenario the protocols are finished, and the run has ended. `progress` and
        `should_stop` are those of `execute`. ValueError if `time_s` is in the past, or is NaN.
        """
        if isnan(time_s) or time_s < self._now():
            raise ValueError(f"cannot run until {time_s!r} s: it is {self._now()} s already")
        limit_s = self._scenario.sim_time_limit_s
        until_s = min(time_s, limit_s)

        def advance(max_events: int) -> bool:
            return self._advanced(until_s, max_events)

        return self._run(lambda: run_in_chunks(advance, self._now, progress, should_stop), until_s == limit_s)

    def step(self) -> bool:
        """Run one event. Return whether the run goes on, which it does not after the last event."""
        return self._run(lambda: self._advanced(self._scenario.sim_time_limit_s, 1), True)

    def finish(self) -> None:
        """End the run now: finish the protocols and finalize the handlers. No-op if the run has ended.

        Before the time limit, the result is marked as interrupted.
        """
        if self._ended:
            return
        if self._has_begun:
            self._end()
        else:
            self._ended = True
            self._release()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.finish()

    def _run(self, advance: Callable[[], bool], to_the_end: bool) -> bool:
        """Begin before the first call, and call `advance`. Return whether the run goes on."""
        if self._ended:
            return False
        with self._measuring_cost():
            try:
                with self._execution():
                    if self._advance is None:
                        self._begin()
                    self._complete = advance() and to_the_end
            except KeyboardInterrupt:
                raise  # the run may go on, or be finished
            except BaseException as failure:
                self._fail(failure)
                raise
        if self._complete:
            self._end()
        return not self._ended

    def _begin(self) -> None:
        self._has_begun = True
        if self._replay is not None:
            self._replay.begin(self._described(self._replay.recorded))
        self._advance = self._start()

    def _advanced(self, until_s: float, max_events: int) -> bool:
        """Run the next events, and record them if the run is recorded; return if `until_s` is reached."""
        assert self._advance is not None
        is_reached = self._advance(until_s, max_events)
        if self._replay is not None and self._recorder is not None:
            for chunk in self._recorder.chunks(cut=self._replay.wants_chunk(), last=False):
                self._replay.add(chunk)
        return is_reached

    def _end(self) -> None:
        """Finish the protocols and release what the run holds."""
        with self._measuring_cost():
            try:
                with self._execution():
                    self._finish()
                    self._end_replay()
            except BaseException as failure:
                self._fail(failure)
                raise
            self._ended = True
            self._release()

    def _fail(self, failure: BaseException) -> None:
        self._ended, self._complete = True, False
        self._lacks_output = isinstance(failure, OutputError)
        try:
            for close in (self._close_after_failure, self._end_replay):
                try:
                    close()
                except OutputError as error:
                    self._lacks_output = True
                    failure.add_note(str(error))
        finally:
            self._release()

    def _end_replay(self) -> None:
        replay, self._replay = self._replay, None
        if replay is None or self._recorder is None:
            return
        for chunk in self._recorder.chunks(cut=False, last=True):
            replay.add(chunk)
        replay.close({"time_s": self._now(), "complete": self._complete})

    @contextmanager
    def _measuring_cost(self) -> Iterator[None]:
        began_s = (perf_counter(), process_time())
        try:
            yield
        finally:
            self._wall_s += perf_counter() - began_s[0]
            self._cpu_s += process_time() - began_s[1]

    def findings(self) -> list[Finding]:
        """Return what lint checks found in the protocols up to now."""
        return self._lint.findings()

    def result(self) -> RunResult:
        """Return what has been computed up to now."""
        scenario = self._scenario
        return RunResult(
            config=scenario.config,
            run=scenario.run_number,
            repetition=scenario.repetition,
            iterations=scenario.iterations,
            settings_hash=scenario.settings_hash,
            file_hashes=scenario.file_hashes,
            seed=scenario.seed,
            mode=self.mode,
            wall_s=self._wall_s,
            cpu_s=self._cpu_s,
            setup_s=self._setup_s,
            interrupted=not self._complete,
            nodes=tuple(self._node_results()),
            **self._measured(),
        )

    def _node_results(self) -> Iterator[NodeResult]:
        for spec, measured in zip(self._scenario.nodes, self._measured_nodes(), strict=True):
            recorder = self._recorders.get(spec.id)
            yield NodeResult(
                id=spec.id,
                name=spec.name,
                protocol=spec.protocol.__name__,
                vectors=None if recorder is None else recorder.vectors(),
                **measured,
            )

    @contextmanager
    def _building(self) -> Iterator[None]:
        """Set up what the constructors of protocols need; without searches for garbage, as there is none."""
        with gc_paused(), self._protocol_environment():
            yield

    def _built(self) -> None:
        """Note what the constructor took, at its end."""
        wall_s, cpu_s = self._constructed_s
        self._wall_s = self._setup_s = perf_counter() - wall_s
        self._cpu_s = process_time() - cpu_s

    @contextmanager
    def _execution(self) -> Iterator[None]:
        """Set up what callbacks of protocols need."""
        with self._protocol_environment():
            yield

    @contextmanager
    def _protocol_environment(self) -> Iterator[None]:
        record_event = None if self._recorder is None else self._recorder.event
        log = self._log.in_use(self._now, self._active_node, record_event)
        with log, siblings_importable(self._protocols), self._random.in_use():
            yield

    @abstractmethod
    def _start(self) -> Callable[[float, int], bool]:
        """Initialize the protocols, and return what runs the next events.

        It takes a simulated time (s) and a number of events, both at most, and returns whether it reached
        that time.
        """

    @abstractmethod
    def _parts_of(self, node_id: int) -> tuple[Any, Any]:
        """Return the encapsulator of a node, and what has its position."""

    @abstractmethod
    def _described(self, recorded: frozenset[int] | None) -> Mapping[str, Any]:
        """Return the description of the run for a replay; `recorded` are nodes, None for all."""

    @abstractmethod
    def _now(self) -> float:
        """Return the simulated time in seconds."""

    @abstractmethod
    def _active_node(self) -> int | None:
        """Return the id of the node whose protocol is called now; None if there is none."""

    @abstractmethod
    def _finish(self) -> None:
        """Finish the protocols and finalize the handlers."""

    @abstractmethod
    def _close_after_failure(self) -> None:
        """Finalize what remains after an exception. Raises OutputError, and nothing else."""

    @abstractmethod
    def _release(self) -> None:
        """Release what the run held, after its end."""

    @abstractmethod
    def _measured(self) -> Mapping[str, Any]:
        """Return the fields of `RunResult` that the mode measures."""

    @abstractmethod
    def _measured_nodes(self) -> Iterable[Mapping[str, Any]]:
        """Return the fields of `NodeResult` that the mode measures, of each node in the order of ids."""


def run_in_chunks(
    advance: Callable[[int], bool],
    now: Callable[[], float],
    progress: Callable[[float], None] | None = None,
    should_stop: Callable[[], bool] | None = None,
) -> bool:
    """Call `advance(max_events)` until it returns True, which says that the run is complete.

    `progress(now())` is called about ten times per second, and once at the end. `should_stop()` is called
    after each chunk. Returns whether the run was completed; False when `should_stop` ended it.
    """
    max_events = FIRST_CHUNK
    last_report = perf_counter()
    complete = stopped = False
    while not complete and not stopped:
        start = perf_counter()
        complete = advance(max_events)
        end = perf_counter()
        max_events = next_chunk(max_events, end - start)
        stopped = should_stop is not None and should_stop() and not complete
        if progress is not None and (complete or stopped or end - last_report >= REPORT_INTERVAL_S):
            last_report = end
            progress(now())
    return complete


def next_chunk(max_events: int, took_s: float) -> int:
    """Return the number of events of the next chunk: at most four times, at least a quarter of the last."""
    factor = min(4.0, max(0.25, CHUNK_S / took_s)) if took_s > 0 else 4.0
    return min(MAX_EVENTS, max(1, int(max_events * factor)))
