"""What an environment calls to make a protocol happen."""

from abc import ABC, abstractmethod
from typing import Any, Generic, TypeVar

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.telemetry import Telemetry

T = TypeVar("T", bound=IProtocol)


class IEncapsulator(ABC, Generic[T]):
    """Holds one protocol and translates between it and one environment.

    What the callbacks return is the environment's affair: in prototype mode nothing, for a host outside the
    list of consequences.

    Attributes:
        protocol: The protocol inside; there from `encapsulate` on.
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
