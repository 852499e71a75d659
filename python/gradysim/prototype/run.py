"""One run in prototype mode.

`run(scenario)` is all that most callers need. Who wants to keep what a failing run computed takes the
object: `execute` may raise, `result` tells at any time how far the run came.
"""

from collections.abc import Callable, Iterable

from gradysim.encapsulator.garbage_collection import garbage_left_alone
from gradysim.encapsulator.global_random import global_random_of
from gradysim.prototype.simulation import build_simulation
from gradysim.results.delays import constant_delays
from gradysim.results.node_recorder import recorders_of
from gradysim.results.node_results import node_results
from gradysim.results.run_account import RunAccount
from gradysim.results.run_result import RunResult
from gradysim.results.slices import run_in_slices
from gradysim.scenario.lint import Finding, RunLint
from gradysim.scenario.protocol.siblings import siblings_importable
from gradysim.scenario.scenario import Scenario
from gradysim.simulator.handler.interface import INodeHandler


class PrototypeRun:
    """A scenario on the plain simulator: built by the constructor, run once by `execute`."""

    def __init__(
        self,
        scenario: Scenario,
        *,
        vectors_of: Iterable[int] = (),
        handlers: Iterable[INodeHandler] = (),
        real_time: bool | float = False,
    ) -> None:
        """Build the simulation and the protocols.

        `vectors_of` are the ids of the nodes whose results have a row for each assignment of a tracked
        variable that is a number, and for each telemetry: `NodeResult.vectors`.

        `handlers` are added to those of communication, timers and mobility: assertions, a viewer, one's own.
        `real_time` lets simulated time go by as on the wall clock (True), or so many times as fast; False or
        0 is full speed.

        Raises ConfigError when the simulator does not accept a value of the scenario, ValueError or TypeError
        when `scenario` is none, `vectors_of` names what is no node, one of the handlers cannot be added or
        `real_time` is no factor, what the constructor of a protocol raises, and SitlError when an autopilot
        does not start.
        """
        self._account = RunAccount(scenario)
        self._scenario = scenario
        self._lint = RunLint(scenario)
        self._recorders = recorders_of(vectors_of, len(scenario.nodes))
        siblings = siblings_importable(node.protocol for node in scenario.nodes)
        with garbage_left_alone(), siblings, global_random_of(scenario.seed):
            self._simulator, self._ledger = build_simulation(scenario, handlers, real_time, self._recorders)

    def execute(
        self,
        progress: Callable[[float], None] | None = None,
        should_stop: Callable[[], bool] | None = None,
    ) -> None:
        """Run to the time limit, or until `should_stop()`, then `finish` the protocols.

        `should_stop()` and `progress(sim_time_s)` are called about ten times a second of wall time. After a
        KeyboardInterrupt, too, protocols are finished before it is passed on: `result` has what was computed.
        Python's `random` is as before when this returns or raises. What a protocol raises is
        passed on, with a note of node, time and callback, and ends the run without `finish`. So does what a
        handler raises, as for an assertion that failed. Handlers are finalized in any case.
        """
        simulator, account = self._simulator, self._account
        siblings = siblings_importable(node.protocol for node in self._scenario.nodes)
        interrupt: KeyboardInterrupt | None = None
        with account.of_execution(), siblings, global_random_of(self._scenario.seed):
            try:
                simulator.run_events(0)  # only initializes the protocols
                self._lint.after_initialize(node.protocol_encapsulator.protocol for node in simulator.nodes)
                account.complete = run_in_slices(
                    lambda max_events: not simulator.run_events(max_events),
                    lambda: simulator.current_time,
                    progress,
                    should_stop,
                )
            except KeyboardInterrupt as pressed:
                interrupt = pressed
            simulator.finalize(complete=account.complete)
            if interrupt is not None:
                raise interrupt

    def findings(self) -> list[Finding]:
        """Return what lint checks found in the protocols up to now."""
        return self._lint.findings()

    def result(self) -> RunResult:
        """Return what has been computed up to now."""
        simulator = self._simulator
        return self._account.result(
            mode="prototype",
            sim_time_s=simulator.current_time,
            events=simulator.iteration,
            fingerprint=None,
            fates={
                "copies": self._ledger.copy_fates(),
                "messages": self._ledger.message_fates(),
            },
            message_delays={
                kind: constant_delays(counts)
                for kind, counts in self._ledger.delays().items()
                if any(counts.values())
            },
            nodes=node_results(
                self._scenario,
                (
                    (node.position, node.protocol_encapsulator.provider.tracked_variables)
                    for node in simulator.nodes
                ),
                recorders=self._recorders,
            ),
        )


def run(
    scenario: Scenario,
    *,
    progress: Callable[[float], None] | None = None,
    should_stop: Callable[[], bool] | None = None,
    vectors_of: Iterable[int] = (),
    handlers: Iterable[INodeHandler] = (),
    real_time: bool | float = False,
) -> RunResult:
    """Run `scenario` on the plain simulator and return its result; see `PrototypeRun` for the details."""
    prototype_run = PrototypeRun(scenario, vectors_of=vectors_of, handlers=handlers, real_time=real_time)
    prototype_run.execute(progress, should_stop)
    return prototype_run.result()
