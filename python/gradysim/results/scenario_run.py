"""Executes a scenario in chunks of events, the same way in both modes, and makes its result.

The simulator executes some events, then control comes back here. So a run can report progress and be stopped.
"""

import logging
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from time import perf_counter, process_time
from typing import Any, ClassVar

from gradysim.encapsulator.run_context import gc_paused, global_random_seeded
from gradysim.replay.chunk import RawChunk
from gradysim.replay.sink import ReplaySink
from gradysim.results.recorder import recorders_of
from gradysim.results.result import Mode, NodeResult, RunResult
from gradysim.results.run_log import RecordEvent, RunLog
from gradysim.scenario.lint import Finding, RunLint
from gradysim.scenario.protocol_modules import siblings_importable
from gradysim.scenario.scenario import Scenario, require_scenario

CHUNK_S = 0.05
"""Wall time that a chunk should take, in seconds."""

REPORT_INTERVAL_S = 0.1
"""Wall time between two calls of `progress`, in seconds."""

FIRST_CHUNK = 64
"""Events of the first chunk: few, as the cost of an event is not known yet."""

MAX_EVENTS = 1 << 20
"""Maximum number of events in a chunk. The chunks of a run that waits for the wall clock are short, whatever
their number of events: it would grow without bound."""


class ScenarioRun(ABC):
    """A scenario in one of the modes: built by the constructor, run once by `execute`.

    `execute` may raise; `result` returns at any time what was computed until then.
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
        self._started_s = (perf_counter(), process_time())
        self._cost_s = (0.0, 0.0)
        self._setup_s = 0.0
        self._complete = False
        self._lint = RunLint(scenario)
        self._recorders = recorders_of(vectors_of, len(scenario.nodes), scenario.vector_record_interval_s)
        self._replay = replay
        self._log_level = log_level

    def execute(
        self,
        progress: Callable[[float], None] | None = None,
        should_stop: Callable[[], bool] | None = None,
    ) -> None:
        """Run to the time limit, or until `should_stop()` returns True, then `finish` the protocols.

        `should_stop()` and `progress(sim_time_s)` are called about ten times per second of wall time. After a
        KeyboardInterrupt, too, protocols are finished before it is raised again. Python's `random` is as
        before when this returns or raises.

        An exception in a protocol is raised with a note of node, time and callback. It ends the run without
        `finish`. So does an exception in a handler, such as that of an assertion that failed. Handlers are
        finalized in any case.
        """
        self._setup_s = perf_counter() - self._started_s[0]
        interrupt: KeyboardInterrupt | None = None
        try:
            with self._execution():
                try:
                    if self._replay is not None:
                        self._replay.begin(self._described(self._replay.recorded))
                    advance = self._recorded(self._start())
                    self._complete = run_in_chunks(advance, self._now, progress, should_stop)
                except KeyboardInterrupt as pressed:
                    interrupt = pressed
                self._finish()
                self._end_replay()
                if interrupt is not None:
                    raise interrupt
        except BaseException:
            self._complete = False
            self._end_replay()
            raise
        finally:
            self._cost_s = (perf_counter() - self._started_s[0], process_time() - self._started_s[1])

    def _recorded(self, advance: Callable[[int], bool]) -> Callable[[int], bool]:
        """Return what runs the next events, and records them if the run is recorded."""
        replay = self._replay
        if replay is None:
            return advance

        def advance_and_record(max_events: int) -> bool:
            is_complete = advance(max_events)
            for chunk in self._recorded_chunks(cut=replay.wants_chunk()):
                replay.add(chunk)
            return is_complete

        return advance_and_record

    def _end_replay(self) -> None:
        replay, self._replay = self._replay, None
        if replay is None:
            return
        for chunk in self._recorded_chunks(last=True):
            replay.add(chunk)
        replay.close({"time_s": self._now(), "complete": self._complete})

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
            wall_s=self._cost_s[0],
            cpu_s=self._cost_s[1],
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

    @contextmanager
    def _execution(self) -> Iterator[None]:
        """Set up what callbacks of protocols need; a mode adds what it has to close after the run."""
        with self._protocol_environment():
            yield

    @contextmanager
    def _protocol_environment(self) -> Iterator[None]:
        siblings = siblings_importable(spec.protocol for spec in self._scenario.nodes)
        # Not kept: both would refer to each other.
        log = RunLog(
            self._log_level, self._scenario.nodes, self._now, self._active_node, self._log_recorder()
        )
        with log, siblings, global_random_seeded(self._scenario.seed):
            yield

    @abstractmethod
    def _start(self) -> Callable[[int], bool]:
        """Initialize the protocols, and return what runs the next events; see `run_in_chunks`."""

    @abstractmethod
    def _described(self, recorded: frozenset[int] | None) -> Mapping[str, Any]:
        """Return the description of the run for a replay; `recorded` are nodes, None for all."""

    @abstractmethod
    def _recorded_chunks(self, *, cut: bool = False, last: bool = False) -> Iterable[RawChunk]:
        """Return the chunks of the replay that are complete.

        With `cut`, the one that is growing ends now; with `last`, the run has ended.
        """

    @abstractmethod
    def _now(self) -> float:
        """Return the simulated time in seconds."""

    @abstractmethod
    def _active_node(self) -> int | None:
        """Return the id of the node whose protocol is called now; None if there is none."""

    @abstractmethod
    def _log_recorder(self) -> RecordEvent | None:
        """Return what records log lines for a replay; None if there is none."""

    @abstractmethod
    def _finish(self) -> None:
        """Finish the protocols and finalize the handlers."""

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
