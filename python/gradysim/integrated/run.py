"""One run in integrated mode.

`run(scenario)` is all that most callers need. Use `IntegratedRun` if you need the partial results of a
failing run.
"""

import logging
import weakref
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gradysim.encapsulator.clock import let_clock_drift
from gradysim.encapsulator.netsim import NetsimEncapsulator, NetsimProvider
from gradysim.encapsulator.run_context import gc_paused
from gradysim.encapsulator.tracked_variables import watch_tracked_variables
from gradysim.execution.scenario_run import ScenarioRun
from gradysim.integrated.autopilot_nodes import AutopilotNodes
from gradysim.integrated.capture import capture_errors, checked_captures, start_captures
from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.handlers import EngineHandlers
from gradysim.integrated.native_protocols import NativeView, is_native
from gradysim.integrated.network import build_network
from gradysim.integrated.ranges import far_losses, ranges_m
from gradysim.integrated.real_time import RealTimeRun
from gradysim.integrated.replay import EngineRecorder, VariableListener
from gradysim.protocol.errors import NativeProtocolError, add_protocol_note
from gradysim.protocol.interface import IProtocol
from gradysim.replay.description import describe, recorded_nodes
from gradysim.replay.sink import ReplaySink
from gradysim.results.delays import Delays
from gradysim.results.files import run_name
from gradysim.results.outcomes import Counts
from gradysim.results.recorder import checked_ids
from gradysim.results.result import RunResult
from gradysim.scenario.ranges import mean_range_m
from gradysim.scenario.scenario import Scenario
from gradysim.scenario.schema.parameters import parametrize
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.real_time import real_time_factor

if TYPE_CHECKING:
    from gradysim._netsim import Node, ProtocolError


class IntegratedRun(ScenarioRun):
    """A scenario on the compiled engine: built by the constructor, then run at once or step by step.

    Errors of a native protocol raise NativeProtocolError. A capture that lacks its end raises CaptureError,
    which is an OutputError.
    """

    mode = "integrated"

    def __init__(
        self,
        scenario: Scenario,
        captures: Mapping[int, str | Path] | None = None,
        *,
        outcomes_at: Iterable[int] = (),
        vectors_of: Iterable[int] = (),
        handlers: Iterable[INodeHandler] = (),
        real_time: bool | float = False,
        replay: ReplaySink | None = None,
        log_level: int = logging.WARNING,
    ) -> None:
        """Build the network and the protocols.

        Args:
            scenario: One of those that `load_scenarios` returns.
            captures: {id of a node: pcap file of its sent and received frames}. `wlan[1]` of a node with
                FILE.pcap writes FILE-wlan1.pcap. The files are complete when the run has ended.
            outcomes_at: Ids of the nodes whose results have outcomes and interferers:
                `NodeResult.frame_outcomes`, `interferers` and `message_outcomes`. They do not change or slow
                the run.
            vectors_of: Ids of the nodes whose results have numbers over time, `NodeResult.vectors`.
            handlers: Watch the run, as in prototype mode: assertions, a viewer, your own. A handler that
                overrides `after_simulation_step` is called after every event of the engine, several for each
                frame: then the run is slow. Other handlers do not slow it.
            real_time: True for the pace of the wall clock, or a factor of it; False or 0 for full speed. For
                viewers: events are up to 10 ms of wall time late.
            replay: Records the run; for example, `ReplayWriter`, which makes a page of it.
            log_level: Log lines from this level on go to standard error, with time and node, unless logging
                has been configured.

        Raises:
            CompiledPartMissingError: The engine has not been built.
            ConfigError: The engine does not accept a value of the scenario, or cannot write a capture file.
            SitlError: An autopilot does not start.
            ValueError, TypeError: `scenario` is not a scenario, an argument names a node that does not exist,
                two interfaces would write one file, a handler cannot work in this mode, or `real_time` is not
                a factor. Exceptions of a protocol's constructor are raised, too.
        """
        super().__init__(scenario, vectors_of, replay, log_level)
        self._real_time_factor = real_time_factor(real_time)
        self._outcomes_at = frozenset(checked_ids("outcomes_at", outcomes_at, len(scenario.nodes)))
        files = checked_captures(captures or {}, scenario)
        with gc_paused():
            self._network, self._nodes = build_network(scenario)
        start_captures(self._network, scenario, files)
        # Protocols and network form a cycle; `execute` breaks it, but may never be called.
        weakref.finalize(self, self._network.release_protocols)
        self._recorder: EngineRecorder | None = (
            None
            if replay is None
            else EngineRecorder(self._network, scenario, recorded_nodes(scenario, replay))
        )
        self._handlers = EngineHandlers(handlers, self._network)
        self._autopilots = AutopilotNodes(scenario, self._network, self._nodes)
        self._encapsulators: list[NetsimEncapsulator[IProtocol] | NativeView] = []
        with self._building():
            self._make_protocols()
        self._autopilots.take_off()
        self._built()

    def _make_protocols(self) -> None:
        scenario = self._scenario
        name = run_name(scenario, self.mode)
        ids_by_name = {spec.name: spec.id for spec in scenario.nodes}
        for spec, node in zip(scenario.nodes, self._nodes, strict=True):
            recorder = self._recorders.get(node.id)
            tell_variable = self._variable_listener(node)
            if tell_variable is not None:
                node.observe(None if recorder is None else recorder.position_told, tell_variable)
            if is_native(spec):
                view = NativeView(node, spec)
                self._encapsulators.append(view)
                self._handlers.register_node(node, view, scenario.seed)
                continue
            provider = NetsimProvider(
                node,
                seed=scenario.seed,
                reference_coordinates=scenario.reference_coordinates,
                nodes=self._nodes,
                handlers=self._handlers.by_label,
                ids_by_name=ids_by_name,
                steer=self._autopilots.steering_of(node.id),
            )
            provider.run_name = name
            provider.has_telemetry = spec.has_telemetry
            provider.initial_position = spec.initial_position
            let_clock_drift(provider, spec.drift_rate)
            if tell_variable is not None:
                watch_tracked_variables(provider, tell_variable)
            encapsulator: NetsimEncapsulator[IProtocol] = NetsimEncapsulator(node, provider)
            encapsulator.encapsulate(parametrize(spec.protocol, spec.protocol_parameters))
            self._encapsulators.append(encapsulator)
            self._handlers.register_node(node, encapsulator, scenario.seed)

    def _variable_listener(self, node: "Node") -> VariableListener | None:
        """Return the recorder of a node's tracked variables; None if they are not used."""
        vectors = self._recorders.get(node.id)
        replay = None if self._recorder is None else self._recorder.variable_listener(node.id)
        if vectors is None:
            return replay
        record_vector, current_time_ps = vectors.variable_set, node.current_time_ps

        def tell(name: str, value: object) -> None:
            record_vector(current_time_ps(), name, value)
            if replay is not None:
                replay(name, value)

        return tell

    @contextmanager
    def _execution(self) -> Iterator[None]:
        with super()._execution():
            try:
                yield
            except load_netsim().ProtocolError as failure:
                raise self._native_failure(failure) from None

    def _close_after_failure(self) -> None:
        self._handlers.finalize_after_failure()
        with capture_errors():
            self._network.close_captures()

    def _release(self) -> None:
        self._autopilots.close()
        self._network.release_protocols()

    def _parts_of(self, node_id: int) -> tuple[Any, Any]:
        return self._encapsulators[node_id], self._nodes[node_id]

    def _start(self) -> Callable[[float, int], bool]:
        self._handlers.initialize()
        self._network.initialize()
        self._lint.after_initialize(encapsulator.protocol for encapsulator in self._encapsulators)
        self._autopilots.initialize()
        handlers, factor = self._handlers, self._real_time_factor
        if factor == 0:
            return handlers.run_until
        return RealTimeRun(handlers.run_until, factor, lambda: handlers.paused_s).advance

    def _described(self, recorded: frozenset[int] | None) -> Mapping[str, Any]:
        return describe(
            self._scenario, self.mode, recorded, ranges_m(self._scenario), far_losses(self._scenario)
        )

    def _now(self) -> float:
        return self._network.now

    def _active_node(self) -> int | None:
        node = self._network.active_node
        return None if node < 0 else node

    def _finish(self) -> None:
        with capture_errors():
            self._network.finish()
        self._handlers.finalize(complete=self._complete)

    def _native_failure(self, failure: "ProtocolError") -> NativeProtocolError:
        """Return the error of a native protocol, with the note that errors in Python get."""
        error = NativeProtocolError(str(failure))
        add_protocol_note(
            error,
            node_id=failure.node_id,
            protocol=self._scenario.nodes[failure.node_id].protocol,
            time_s=failure.time_s,
            callback=failure.callback,
        )
        return error

    def _measured(self) -> Mapping[str, Any]:
        network = self._network
        return {
            "sim_time_s": network.now,
            "events": network.event_count,
            "fingerprint": network.fingerprint,
            "outcomes": {"frames": network.frame_outcomes(), "messages": network.message_outcomes()},
            "range_m": mean_range_m(ranges_m(self._scenario)),
            "message_delays": {kind: Delays(**delays) for kind, delays in network.message_delays().items()},
        }

    def _measured_nodes(self) -> Iterator[Mapping[str, Any]]:
        network = self._network
        for node, encapsulator in zip(self._nodes, self._encapsulators, strict=True):
            measured: dict[str, Any] = {
                "position": node.position,
                "tracked_variables": dict(encapsulator.provider.tracked_variables),
                "frames_by_bitrate": network.frames_by_bitrate(node.id),
            }
            if node.id in self._outcomes_at:
                measured.update(self._outcomes_of_node(node.id))
            yield measured

    def _outcomes_of_node(self, node_id: int) -> Mapping[str, Any]:
        """Return the counts at one node. Only on request, since they take long for thousands of nodes."""
        network, specs = self._network, self._scenario.nodes
        return {
            "frame_outcomes": _without_zeros(network.frame_outcomes_at(node_id)),
            "interferers": {specs[by].name: count for by, count in network.interferers_at(node_id).items()},
            "message_outcomes": {
                interface: _without_zeros(counts)
                for interface, counts in network.message_outcomes_from(node_id).items()
            },
        }


def _without_zeros(counts: Counts) -> dict[str, dict[str, int]]:
    met = {
        kind: {outcome: count for outcome, count in each.items() if count} for kind, each in counts.items()
    }
    return {kind: each for kind, each in met.items() if each}


def run(
    scenario: Scenario,
    *,
    progress: Callable[[float], None] | None = None,
    should_stop: Callable[[], bool] | None = None,
    captures: Mapping[int, str | Path] | None = None,
    outcomes_at: Iterable[int] = (),
    vectors_of: Iterable[int] = (),
    handlers: Iterable[INodeHandler] = (),
    real_time: bool | float = False,
    replay: ReplaySink | None = None,
    log_level: int = logging.WARNING,
) -> RunResult:
    """Run `scenario` on the compiled engine and return its result; see `IntegratedRun` for the arguments."""
    integrated_run = IntegratedRun(
        scenario,
        captures,
        outcomes_at=outcomes_at,
        vectors_of=vectors_of,
        handlers=handlers,
        real_time=real_time,
        replay=replay,
        log_level=log_level,
    )
    integrated_run.execute(progress, should_stop)
    return integrated_run.result()
