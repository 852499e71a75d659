"""A node of the engine as handlers see it."""

from typing import TYPE_CHECKING, Any

from gradysim.encapsulator.netsim import NetsimEncapsulator
from gradysim.integrated.native_protocols import NativeView
from gradysim.protocol.position import Position

if TYPE_CHECKING:
    from gradysim._netsim import Node


class NodeView:
    """Stands for `gradysim.simulator.node.Node` in what `INodeHandler.register_node` gives to a handler.

    Attributes:
        id: Unique in the network.
        protocol_encapsulator: Holds its protocol.
        seed: Seed of the run.
    """

    def __init__(
        self, node: "Node", protocol_encapsulator: NetsimEncapsulator[Any] | NativeView, seed: int
    ) -> None:
        self.id = node.id
        self.protocol_encapsulator = protocol_encapsulator
        self.seed = seed
        self._node = node

    @property
    def position(self) -> Position:
        """(x, y, z) in metres, now. The engine moves the nodes: it cannot be set."""
        return self._node.position

    @position.setter
    def position(self, _: Position) -> None:
        raise AttributeError(
            f"the position of node {self.id} cannot be set in integrated mode, where the engine moves "
            "the nodes: a handler that moves them works in prototype mode only; a protocol sends mobility "
            "commands"
        )
