"""Commands with which a protocol changes what the viewers of the simulation show."""

import math
from typing import Any, ClassVar

from gradysim.protocol.checked_values import is_in_range
from gradysim.protocol.interface import IProtocol
from gradysim.simulator.extension.extension import Extension, handler_of

Color = tuple[float, float, float]
"""(red, green, blue)."""


class VisualizationController(Extension):
    """Sends commands to the viewers. Any node's protocol can create one.

    The commands have no effect without a visualization handler or in a mode without viewers. Invalid
    arguments are always errors.
    """

    _warns_elsewhere: ClassVar[bool] = False

    def __init__(self, protocol: IProtocol) -> None:
        """Attach to the protocol of a node.

        ReferenceError if it has no provider yet, as in its constructor.
        """
        super().__init__(protocol)
        self._handler = handler_of(protocol, "visualization")

    def paint_node(self, node_id: int, color: Color) -> None:
        """Set the color of a node; each component is from 0 to 255."""
        self._check_node(node_id)
        self._send("paint_node", node_id=node_id, color=_checked_color(color, 255))

    def paint_environment(self, color: Color) -> None:
        """Set the color of the background; each component is >= 0, and 1 is full brightness."""
        self._send("paint_environment", color=_checked_color(color, math.inf))

    def resize_nodes(self, size: float) -> None:
        """Draw all nodes with this radius in meters, > 0."""
        if not is_in_range(size, 0, above=True):
            raise ValueError(f"the size of nodes must be a finite number > 0, got {size!r}")
        self._send("resize_nodes", size=size)

    def show_node_id(self, node_id: int, show: bool) -> None:
        """Show or hide the label of a node."""
        self._check_node(node_id)
        if not isinstance(show, bool):
            raise TypeError(f"show must be True or False, got {show!r}")
        self._send("show_node_id", node_id=node_id, show=show)

    def _check_node(self, node_id: int) -> None:
        if not isinstance(node_id, int) or isinstance(node_id, bool):
            raise TypeError(f"expected the id of a node, an integer, got {node_id!r}")
        known = getattr(self._handler, "nodes", None)
        if known and node_id not in known:
            raise ValueError(f"there is no node {node_id!r}, only {sorted(known)}")

    def _send(self, command: str, **payload: Any) -> None:
        if self._handler is not None:
            self._handler.command_queue.put({"command": command, "payload": payload})


def _checked_color(color: Color, greatest: float) -> Color:
    parts = tuple(color) if isinstance(color, tuple | list) else ()
    if len(parts) != 3 or not all(is_in_range(part, 0, greatest) for part in parts):
        limits = "of 0 to 255" if math.isfinite(greatest) else ">= 0"
        raise ValueError(f"a color must be (red, green, blue), three numbers {limits}, got {color!r}")
    return (parts[0], parts[1], parts[2])
