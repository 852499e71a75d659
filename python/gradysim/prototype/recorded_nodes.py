"""Has the nodes of a simulation tell recorders what they do over time."""

from collections.abc import Mapping
from typing import Any

from gradysim.encapsulator.watched_provider import watch_tracked_variables
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.results.node_recorder import NodeRecorder
from gradysim.simulator.node import Node
from gradysim.simulator.simulation import Simulator

_PS_PER_S = 1e12


def record_nodes(simulator: Simulator, recorders: Mapping[int, NodeRecorder]) -> None:
    """Have nodes, by their ids, recorded; to be called before the simulation begins."""
    for node_id, recorder in recorders.items():
        _record(simulator, simulator.get_node(node_id), recorder)


def _record(simulator: Simulator, node: Node[Any], recorder: NodeRecorder) -> None:
    encapsulator = node.protocol_encapsulator
    handle_telemetry = encapsulator.handle_telemetry

    def now_ps() -> int:
        return round(simulator.current_time * _PS_PER_S)

    def record_and_handle(telemetry: Telemetry) -> None:
        recorder.position_told(now_ps(), *telemetry.current_position)
        handle_telemetry(telemetry)

    # An attribute of the instance hides the method of the class: other nodes are called as ever.
    setattr(encapsulator, "handle_telemetry", record_and_handle)  # noqa: B010
    watch_tracked_variables(
        encapsulator.provider, lambda name, value: recorder.variable_set(now_ps(), name, value)
    )
