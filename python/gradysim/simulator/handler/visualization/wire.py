"""The messages between a simulation and its viewers: JSON texts over a WebSocket.

To the viewer, once: {"x_range", "y_range", "z_range": [low, high], "nodes": [label, ...]}; then, again and
again: {"nodes": [id, ...], "positions": [[x, y, z], ...], "simulation_time": s, "real_time": s,
"tracked_variables": [{name: value}, ...]}; and {"command": name, "payload": {...}} in between. From the
viewer: {"interaction": "pause/resume"}.
"""

import json
from collections.abc import Sequence
from typing import Any

from gradysim.protocol.plain_value import plain_value
from gradysim.simulator.handler.visualization.configuration import VisualizationConfiguration
from gradysim.simulator.log import label_node
from gradysim.simulator.node import Node


def greeting(configuration: VisualizationConfiguration, nodes: Sequence[Node[Any]]) -> str:
    """Return the first message to each viewer."""
    return _text(
        {
            "x_range": configuration.x_range,
            "y_range": configuration.y_range,
            "z_range": configuration.z_range,
            "nodes": [label_node(node) for node in nodes],
        }
    )


def snapshot(nodes: Sequence[Node[Any]], simulation_s: float, real_s: float) -> str:
    """Return the state of all nodes as a message."""
    return _text(
        {
            "nodes": [node.id for node in nodes],
            "positions": [node.position for node in nodes],
            "simulation_time": simulation_s,
            "real_time": real_s,
            "tracked_variables": [_tracked_variables(node) for node in nodes],
        }
    )


def command_text(command: dict[str, Any]) -> str:
    """Return a command as a message."""
    return _text(command)


def is_pause_or_resume(message: str | bytes) -> bool:
    """Whether a viewer's message asks to pause or to go on.

    Raises:
        ValueError: It asks for something unknown.
    """
    try:
        content = json.loads(message)
    except ValueError:
        content = None
    if isinstance(content, dict) and content.get("interaction") == "pause/resume":
        return True
    raise ValueError(f'expected {{"interaction": "pause/resume"}} of a viewer, got {message[:200]!r}')


def _tracked_variables(node: Node[Any]) -> dict[str, Any]:
    protocol = getattr(node.protocol_encapsulator, "protocol", None)
    provider = getattr(protocol, "provider", None)
    return getattr(provider, "tracked_variables", {})


def _text(message: dict[str, Any]) -> str:
    try:
        return json.dumps(message, allow_nan=False)
    except (TypeError, ValueError, RecursionError):  # seldom: most tracked variables are plain
        return json.dumps(plain_value(message, nan="nan"), allow_nan=False)
