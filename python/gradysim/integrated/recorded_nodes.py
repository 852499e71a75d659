"""Has the engine, and protocols in Python, tell a recorder what a node does over time."""

from typing import TYPE_CHECKING, Any

from gradysim.encapsulator.netsim import NetsimEncapsulator
from gradysim.encapsulator.tracked_variables import watch_tracked_variables
from gradysim.results.node_recorder import NodeRecorder

if TYPE_CHECKING:
    from gradysim._netsim import Node


def record_node(node: "Node", recorder: NodeRecorder) -> None:
    """Record where a node is, and what its protocol tracks if it is a native one."""
    node.observe(recorder.position_told, recorder.variable_set)


def record_protocol(encapsulator: NetsimEncapsulator[Any], node: "Node", recorder: NodeRecorder) -> None:
    """Record what a protocol in Python tracks; to be called before it is made."""
    watch_tracked_variables(
        encapsulator.provider,
        lambda name, value: recorder.variable_set(node.current_time_ps(), name, value),
    )
