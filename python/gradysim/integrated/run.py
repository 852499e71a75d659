"""One run in integrated mode.

`run(scenario)` is all that most callers need. Who wants to keep what a failing run computed takes the
object: `execute` may raise, `result` tells at any time how far the run came.
"""

import weakref
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from gradysim.encapsulator.failure import add_protocol_note
from gradysim.encapsulator.garbage_collection import garbage_left_alone
from gradysim.encapsulator.global_random import global_random_of
from gradysim.encapsulator.netsim import NetsimEncapsulator
from gradysim.integrated.capture import (
    capture_errors,
    captures_completed_after_failure,
    checked_captures,
    start_captures,
)
from gradysim.integrated.compiled_part import load_netsim
from gradysim.integrated.fates_at import checked_fates_at, with_fates
from gradysim.integrated.flown_nodes import FlownNodes
from gradysim.integrated.handlers import EngineHandlers
from gradysim.integrated.native_protocols import NativeView, is_native
from gradysim.integrated.network import build_network
from gradysim.integrated.real_time import RealTimeRun
from gradysim.integrated.recorded_nodes import record_node, record_protocol
from gradysim.protocol.errors import NativeProtocolError
from gradysim.protocol.interface import IProtocol
from gradysim.results.delays import Delays
from gradysim.results.node_recorder import recorders_of
from gradysim.results.node_results import node_results
from gradysim.results.run_account import RunAccount
from gradysim.results.run_file import run_name
from gradysim.results.run_result import RunResult
from gradysim.results.slices import run_in_slices
from gradysim.scenario.lint import Finding, RunLint
from gradysim.scenario.protocol.parametrize import parametrize
from gradysim.scenario.protocol.siblings import siblings_importable
from gradysim.scenario.scenario import Scenario
from gradysim.simulator.handler.interface import INodeHandler
from gradysim.simulator.real_time import real_time_factor

if TYPE_CHECKING:
    from gradysim._netsim import ProtocolError


class IntegratedRun:
    """A scenario on the compiled engine: built by the constructor, run once by `execute`."""

    def __init__(
        self,
        scenario: Scenario,
        captures: Mapping[int, str | Path] | None = None,
        *,
        fates_at: Iterable[int] = (),
        vectors_of: Iterable[int] = (),
        handlers: Iterable[INodeHandler] = (),
        real_time: bool | float = False,
    ) -> None:
        """Build the network and the protocols.

        `handlers` watch the run, as those of prototype mode: assertions, a viewer, one's own. One of them
        that overrides `after_simulation_step` gets its turn after every event of the engine, of which there
        are several for each frame. The run is slow then, one event at a time; other handlers do not slow it.

        `captures` says for the ids of some nodes in which pcap file to write what they send and receive:
        what `wlan[1]` of a node with FILE.pcap does is in FILE-wlan1.pcap. The files are complete when
        `execute` returns or raises.

        `fates_at` are the ids of the nodes whose results tell what became of frames there, who interfered,
        and what became of messages that they sent: `NodeResult.frame_fates`, `interferers` and
        `message_fates`. The run itself is the same, and as fast.

        `vectors_of` are the ids of the nodes whose results have a row for each assignment of a tracked
        variable that is a number, and for each telemetry: `NodeResult.vectors`.

        `real_time` lets simulated time go by as on the wall clock (True), or so many times as fast; False or
        0 is full speed. For viewers: events are up to 10 ms of wall time late.

        Raises CompiledPartMissingError when the engine has not been built, ConfigError when it does not
        accept a value of the scenario or cannot write a capture file, SitlError when an autopilot does not
        start, ValueError or TypeError when `scenario` is none, `fates_at`, `vectors_of` or `captures`
        names what is no node, two interfaces would write one file, a handler cannot work in this mode or
        `real_time` is no factor, and what the constructor of a protocol raises.
        """
        self._account = RunAccount(scenario)
        self._scenario = scenario
        self._lint = RunLint(scenario)
        self._real_time_factor = real_time_factor(real_time)
        self._fates_at = checked_fates_at(fates_at, len(scenario.nodes))
        self._recorders = recorders_of(vectors_of, len(scenario.nodes))
        files = checked_captures(captures or {}, scenario)
        with garbage_left_alone():
            self._network, self._nodes = build_network(scenario)
        start_captures(self._network, scenario, files)
        # Protocols and network refer to each other; `execute` parts them, but need not be called or reached.
        weakref.finalize(self, self._network.release_protocols)
        self._handlers = EngineHandlers(handlers, self._network)
        self._flown = FlownNodes(scenario, self._network, self._nodes)
        self._encapsulators: list[NetsimEncapsulator[IProtocol] | NativeView] = []
        siblings = siblings_importable(spec.protocol for spec in scenario.nodes)
        with garbage_left_alone(), siblings, global_random_of(scenario.seed):
            self._make_protocols()
        self._flown.take_off()

    def _make_protocols(self) -> None:
        scenario = self._scenario
        name = run_name(scenario, "integrated")
        for node_id, recorder in self._recorders.items():
            record_node(self._nodes[node_id], recorder)
        for spec, node in zip(scenario.nodes, self._nodes, strict=True):
            if is_native(spec):
                view = NativeView(node, spec)
                self._encapsulators.append(view)
                self._handlers.register_node(node, view, scenario.seed)
                continue
            encapsulator: NetsimEncapsulator[IProtocol] = NetsimEncapsulator(
                node,
                seed=scenario.seed,
                reference_coordinates=scenario.reference_coordinates,
                nodes=self._nodes,
                handlers=self._handlers.by_label,
                steer=self._flown.steering_of(node.id),
            )
            encapsulator.provider.run_name = name
            if node.id in self._recorders:
                record_protocol(encapsulator, node, self._recorders[node.id])
            encapsulator.encapsulate(parametrize(spec.protocol, spec.protocol_parameters))
            self._encapsulators.append(encapsulator)
            self._handlers.register_node(node, encapsulator, scenario.seed)

    def execute(
        self,
        progress: Callable[[float], None] | None = None,
        should_stop: Callable[[], bool] | None = None,
    ) -> None:
        """Run to the time limit, or until `should_stop()`, then `finish` the protocols.

        `should_stop()` and `progress(sim_time_s)` are called about ten times a second of wall time. After a
        KeyboardInterrupt, too, protocols are finished before it is passed on: `result` has what was computed.
        Python's `random` is as before when this returns or raises. What a protocol raises is
        passed on, with a note of node, time and callback, and ends the run without `finish`; what a native
        one gets wrong becomes a NativeProtocolError with such a note. So does what a handler raises, as for
        an assertion that failed. Handlers are finalized in any case. A capture file that could not be written
        to its end raises CaptureError when all else is done, or adds a note to what was raised before.
        """
        siblings = siblings_importable(spec.protocol for spec in self._scenario.nodes)
        captures = captures_completed_after_failure(self._network)
        stream = global_random_of(self._scenario.seed)
        with captures, siblings, stream, self._account.of_execution():
            self._execute(progress, should_stop)

    def _execute(
        self, progress: Callable[[float], None] | None, should_stop: Callable[[], bool] | None
    ) -> None:
        network, account = self._network, self._account
        interrupt: KeyboardInterrupt | None = None
        try:
            try:
                self._handlers.initialize()
                network.initialize()
                self._lint.after_initialize(encapsulator.protocol for encapsulator in self._encapsulators)
                self._flown.initialize()
                account.complete = run_in_slices(self._advance(), lambda: network.now, progress, should_stop)
            except KeyboardInterrupt as pressed:
                interrupt = pressed
            with capture_errors():
                network.finish()
            self._handlers.finalize(complete=account.complete)
            if interrupt is not None:
                raise interrupt
        except load_netsim().ProtocolError as failure:
            raise self._native_failure(failure) from None
        finally:
            self._handlers.finalize_after_failure()
            self._flown.close()
            network.release_protocols()

    def _native_failure(self, failure: "ProtocolError") -> NativeProtocolError:
        """Return what a native protocol got wrong, told as the exception of one in Python."""
        told = NativeProtocolError(str(failure))
        add_protocol_note(
            told,
            node_id=failure.node_id,
            protocol=self._scenario.nodes[failure.node_id].protocol,
            time_s=failure.time_s,
            callback=failure.callback,
        )
        return told

    def _advance(self) -> Callable[[int], bool]:
        """Return what runs the next events, at the pace that is wanted; its clock starts now."""
        handlers, limit_s, factor = self._handlers, self._scenario.sim_time_limit_s, self._real_time_factor
        if factor == 0:
            return lambda max_events: handlers.run_until(limit_s, max_events)
        return RealTimeRun(handlers.run_until, limit_s, factor, lambda: handlers.held_up_s).advance

    def findings(self) -> list[Finding]:
        """Return what lint checks found in the protocols up to now."""
        return self._lint.findings()

    def result(self) -> RunResult:
        """Return what has been computed up to now."""
        network = self._network
        nodes = node_results(
            self._scenario,
            (
                (node.position, encapsulator.provider.tracked_variables)
                for node, encapsulator in zip(self._nodes, self._encapsulators, strict=True)
            ),
            [network.frames_by_bitrate(node.id) for node in self._nodes],
            self._recorders,
        )
        return self._account.result(
            mode="integrated",
            sim_time_s=network.now,
            events=network.event_count,
            fingerprint=network.fingerprint,
            fates={"frames": network.frame_fates(), "messages": network.message_fates()},
            message_delays={kind: Delays(**told) for kind, told in network.message_delays().items()},
            nodes=with_fates(nodes, self._fates_at, network),
        )


def run(
    scenario: Scenario,
    *,
    progress: Callable[[float], None] | None = None,
    should_stop: Callable[[], bool] | None = None,
    captures: Mapping[int, str | Path] | None = None,
    fates_at: Iterable[int] = (),
    vectors_of: Iterable[int] = (),
    handlers: Iterable[INodeHandler] = (),
    real_time: bool | float = False,
) -> RunResult:
    """Run `scenario` on the compiled engine and return its result; see `IntegratedRun` for the details."""
    integrated_run = IntegratedRun(
        scenario,
        captures,
        fates_at=fates_at,
        vectors_of=vectors_of,
        handlers=handlers,
        real_time=real_time,
    )
    integrated_run.execute(progress, should_stop)
    return integrated_run.result()
