"""What a simulated environment can tell beyond the contract: where all nodes are."""

from collections.abc import Mapping
from typing import Protocol, runtime_checkable

from gradysim.protocol.position import Position


@runtime_checkable
class NodePositions(Protocol):
    """A provider that knows the physical world, as those of both simulators do; for extensions."""

    def node_positions(self) -> Mapping[int, Position]:
        """Return the position now of every node, (x, y, z) in metres by id."""
