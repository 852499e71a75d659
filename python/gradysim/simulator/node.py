"""A node of a simulation: what the handlers of its parts share."""

from typing import Any, Generic, TypeVar

from gradysim.protocol.position import Position

T = TypeVar("T")


class Node(Generic[T]):
    """A place in the network, with a protocol; made without arguments and filled in by the simulator.

    Attributes:
        id: Unique in the network.
        protocol_encapsulator: Holds its protocol; anything with `handle_packet`, `handle_timer` and
            `handle_telemetry`.
        position: (x, y, z) in metres, now.
        seed: Seed of the run, from which the node's streams of random numbers come.
    """

    id: int
    protocol_encapsulator: Any
    position: Position
    seed: int = 0
