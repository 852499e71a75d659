"""One run in prototype mode.

`run(scenario)` is all that most callers need. Use `PrototypeRun` if you need the partial results of a failing
run.
"""

import logging
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from gradysim.execution.scenario_run import ScenarioRun
from gradysim.prototype.replay import PrototypeRecorder
from gradysim.prototype.simulation import build_simulation
from gradysim.replay.description import describe, recorded_nodes
from gradysim.replay.sink import ReplaySink
from gradysim.results.delays import constant_delays
from gradysim.results.result import RunResult
from gradysim.scenario.ranges import mean_range_m, ranges_of_prototype_m
from gradysim.scenario.scenario import Scenario
from gradysim.simulator.handler.interface import INodeHandler


class PrototypeRun(ScenarioRun):
    """A scenario on the plain simulator: built by the constructor, then run at once or step by step."""

    mode = "prototype"

    def __init__(
        self,
        scenario: Scenario,
        *,
        vectors_of: Iterable[int] = (),
        handlers: Iterable[INodeHandler] = (),
        real_time: bool | float = False,
        replay: ReplaySink | None = None,
        log_level: int = logging.WARNING,
    ) -> None:
        """Build the simulation and the protocols.

        Args:
            scenario: One of those that `load_scenarios` returns.
            vectors_of: Ids of the nodes whose results have vectors, `NodeResult.vectors`.
            handlers: Added to those of communication, timers and mobility: assertions, a viewer, your own.
            real_time: True for the pace of the wall clock, or a factor of it; False or 0 for full speed.
            replay: Records the run; for example, `ReplayWriter`, which makes a page of it.
            log_level: Log lines from this level on go to standard error, with time and node, unless logging
                has been configured.

        Raises:
            ConfigError: The simulator does not accept a value of the scenario.
            SitlError: An autopilot does not start.
            ValueError, TypeError: `scenario` is not a scenario, `vectors_of` names a node that does not
                exist, a handler cannot be added, or `real_time` is not a factor. Exceptions of a protocol's
                constructor are raised, too.
        """
        super().__init__(scenario, vectors_of, replay, log_level)
        self._recorder: PrototypeRecorder | None = (
            None if replay is None else PrototypeRecorder(self._now, recorded_nodes(scenario, replay))
        )
        with self._building():
            self._simulator, self._ledger = build_simulation(
                scenario, handlers, real_time, self._recorders, self._recorder
            )
        self._built()

    def _start(self) -> Callable[[float, int], bool]:
        simulator = self._simulator
        simulator.run_events(0)  # only initializes the protocols
        self._lint.after_initialize(node.protocol_encapsulator.protocol for node in simulator.nodes)
        return simulator.run_until

    def _parts_of(self, node_id: int) -> tuple[Any, Any]:
        node = self._simulator.nodes[node_id]
        return node.protocol_encapsulator, node

    def _described(self, recorded: frozenset[int] | None) -> Mapping[str, Any]:
        return describe(self._scenario, self.mode, recorded, ranges_of_prototype_m(self._scenario))

    def _now(self) -> float:
        return self._simulator.current_time if hasattr(self, "_simulator") else 0.0

    def _active_node(self) -> int | None:
        return self._simulator.active_node if hasattr(self, "_simulator") else None

    def _finish(self) -> None:
        self._simulator.finalize(complete=self._complete)

    def _close_after_failure(self) -> None:
        """Do nothing: the simulator finalizes its handlers itself."""

    def _release(self) -> None:
        """Do nothing: the simulator does this itself."""

    def _measured(self) -> Mapping[str, Any]:
        simulator, ledger = self._simulator, self._ledger
        return {
            "sim_time_s": simulator.current_time,
            "events": simulator.iteration,
            "fingerprint": None,
            "outcomes": {"frames": ledger.frame_outcomes(), "messages": ledger.message_outcomes()},
            "range_m": mean_range_m(ranges_of_prototype_m(self._scenario)),
            "message_delays": {
                kind: constant_delays(counts)
                for kind, counts in ledger.delays().items()
                if any(counts.values())
            },
        }

    def _measured_nodes(self) -> Iterator[Mapping[str, Any]]:
        for node in self._simulator.nodes:
            tracked = node.protocol_encapsulator.provider.tracked_variables
            yield {"position": node.position, "tracked_variables": dict(tracked)}


def run(
    scenario: Scenario,
    *,
    progress: Callable[[float], None] | None = None,
    should_stop: Callable[[], bool] | None = None,
    vectors_of: Iterable[int] = (),
    handlers: Iterable[INodeHandler] = (),
    real_time: bool | float = False,
    replay: ReplaySink | None = None,
    log_level: int = logging.WARNING,
) -> RunResult:
    """Run `scenario` on the plain simulator and return its result; see `PrototypeRun` for the arguments."""
    prototype_run = PrototypeRun(
        scenario,
        vectors_of=vectors_of,
        handlers=handlers,
        real_time=real_time,
        replay=replay,
        log_level=log_level,
    )
    prototype_run.execute(progress, should_stop)
    return prototype_run.result()
