"""A node of a simulation: the state that its handlers share."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Generic, TypeVar

from gradysim.protocol.position import Position

T = TypeVar("T")


class Node(Generic[T]):
    """A node with a position and a protocol. It is made without arguments; the simulator sets the attributes.

    Attributes:
        id: Unique id in the network.
        protocol_encapsulator: Holds the protocol; any object with `handle_packet`, `handle_timer` and
            `handle_telemetry`.
        position: Current (x, y, z) in meters.
        ids_by_name: Ids of all nodes of the simulation that have a name.
        seed: Seed of the run, from which the node's random streams follow.
    """

    id: int
    protocol_encapsulator: Any
    position: Position
    seed: int = 0
    ids_by_name: Mapping[str, int] = MappingProxyType({})
