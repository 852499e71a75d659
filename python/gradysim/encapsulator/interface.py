"""The interface of an encapsulator: what an environment calls to run a protocol."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any, Generic, Protocol, TypeVar, runtime_checkable

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.position import Position

T = TypeVar("T", bound=IProtocol)


class IEncapsulator(ABC, Generic[T]):
    """Holds one protocol and translates between it and one environment.

    The return value of a callback depends on the environment. Prototype mode ignores it;
    `InteropEncapsulator` returns the list of consequences.

    Attributes:
        protocol: The protocol inside; set by `encapsulate`.
    """

    protocol: T

    @abstractmethod
    def encapsulate(self, protocol: type[T]) -> None:
        """Make an instance of the protocol, with a provider of this environment."""

    @abstractmethod
    def initialize(self) -> Any:
        """Run the protocol's `initialize`."""

    @abstractmethod
    def handle_timer(self, timer: str) -> Any:
        """Run the protocol's `handle_timer`."""

    @abstractmethod
    def handle_packet(self, message: str) -> Any:
        """Run the protocol's `handle_packet`."""

    @abstractmethod
    def handle_telemetry(self, telemetry: Telemetry) -> Any:
        """Run the protocol's `handle_telemetry`."""

    @abstractmethod
    def finish(self) -> Any:
        """Run the protocol's `finish`."""


@runtime_checkable
class NodePositions(Protocol):
    """Provider of a simulator, which knows the position of every node. For extensions."""

    def node_positions(self) -> Mapping[int, Position]:
        """Return the current position (x, y, z) in meters of every node, by id."""
