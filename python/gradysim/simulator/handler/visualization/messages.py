"""Messages between a simulation and its viewers: JSON over a WebSocket.

Once to each viewer: {"x_range", "y_range", "z_range": [low, high], "nodes": [label, ...]}. Then repeatedly:
{"nodes": [id, ...], "positions": [[x, y, z], ...], "simulation_time": s, "real_time": s,
"tracked_variables": [{name: value}, ...]}. In between: {"command": name, "payload": {...}}. From the viewer:
{"interaction": "pause/resume"}.
"""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from queue import Queue
from typing import Any

from gradysim.protocol.checked_values import checked_range, is_in_range
from gradysim.protocol.plain_value import plain_value
from gradysim.simulator.log import label_node
from gradysim.simulator.node import Node


@dataclass
class VisualizationConfiguration:
    """Configuration of a `VisualizationHandler`. ValueError names an invalid value.

    Attributes:
        information_collection_interval: Simulated time between two collections of the nodes' state, of which
            at most one is sent per `update_rate`. It is also the delay of a pause; s, > 0.
        update_rate: Wall time between two updates sent to the viewers; s, > 0.
        x_range: (lowest, highest) x of the drawn ground; m.
        y_range: The same for y.
        z_range: The same for z.
        host: Address to listen on. With another one than localhost, other machines can watch and pause, too.
        port: Port to listen on; 0 for any free port. The public viewer looks for 5678 on localhost.
        open_browser: Open the page of the handler in a web browser when the simulation starts.
    """

    information_collection_interval: float = 0.01
    update_rate: float = 0.05
    x_range: tuple[float, float] = (-50, 50)
    y_range: tuple[float, float] = (-50, 50)
    z_range: tuple[float, float] = (0, 50)
    host: str = "localhost"
    port: int = 5678
    open_browser: bool = False

    def __post_init__(self) -> None:
        for name in ("information_collection_interval", "update_rate"):
            value = getattr(self, name)
            if not is_in_range(value, 0, above=True):
                raise ValueError(f"{name} must be finite and > 0 s, got {value!r}")
        for name in ("x_range", "y_range", "z_range"):
            checked_range(name, getattr(self, name), ValueError)
        if not isinstance(self.port, int) or not 0 <= self.port <= 65535:
            raise ValueError(f"port must be an integer from 0 to 65535, got {self.port!r}")


Command = dict[str, Any]
"""{"command": name, "payload": {...}}, of plain values; colors are tuples."""

# Longer queues drop commands that later ones replace.
_LENGTH_LIMIT = 10_000


class CommandQueue(Queue[Command]):
    """Commands to the viewers, first in, first out. The server's thread takes them out.

    Without a viewer they wait, perhaps for hours. A long queue keeps only the last one of each kind and node.
    """

    def __init__(self) -> None:
        super().__init__()
        self._limit = _LENGTH_LIMIT

    def _put(self, item: Command) -> None:
        super()._put(item)
        if len(self.queue) > self._limit:
            last = {
                (command["command"], command["payload"].get("node_id")): command for command in self.queue
            }
            kept = {id(command) for command in last.values()}
            commands = [command for command in self.queue if id(command) in kept]
            self.queue.clear()
            self.queue.extend(commands)
            self._limit = max(_LENGTH_LIMIT, 2 * len(commands))


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
    """Return whether a viewer's message asks to pause or resume.

    Raises:
        ValueError: It asks for something unknown.
    """
    try:
        content = json.loads(message)
    except (ValueError, RecursionError):
        content = None
    if isinstance(content, dict) and content.get("interaction") == "pause/resume":
        return True
    raise ValueError(f'expected {{"interaction": "pause/resume"}} from a viewer, got {message[:200]!r}')


def _tracked_variables(node: Node[Any]) -> dict[str, Any]:
    protocol = getattr(node.protocol_encapsulator, "protocol", None)
    provider = getattr(protocol, "provider", None)
    return getattr(provider, "tracked_variables", {})


def _text(message: dict[str, Any]) -> str:
    try:
        return json.dumps(message, allow_nan=False)
    except (TypeError, ValueError, RecursionError):  # rare: most tracked variables are plain
        return json.dumps(plain_value(message, nan="nan"), allow_nan=False)
