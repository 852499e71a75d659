"""Has a node of a simulation tell a recorder what it does over time."""

from collections.abc import Callable
from typing import Any

from gradysim.encapsulator.watched_provider import watch_tracked_variables
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.results.recorder import NodeRecorder
from gradysim.simulator.node import Node

_PS_PER_S = 1e12


def record_node(node: Node[Any], recorder: NodeRecorder) -> None:
    """Have a node recorded. To be called before its protocol is made: it may keep `tracked_variables`."""
    encapsulator = node.protocol_encapsulator
    handle_telemetry = encapsulator.handle_telemetry
    current_time: Callable[[], float] = encapsulator.provider.current_time

    def now_ps() -> int:
        return round(current_time() * _PS_PER_S)

    def record_and_handle(telemetry: Telemetry) -> None:
        recorder.position_told(now_ps(), *telemetry.current_position)
        handle_telemetry(telemetry)

    # An attribute of the instance hides the method of the class: other nodes are called as ever.
    setattr(encapsulator, "handle_telemetry", record_and_handle)  # noqa: B010
    watch_tracked_variables(
        encapsulator.provider, lambda name, value: recorder.variable_set(now_ps(), name, value)
    )
