"""The contract between a protocol and the environment that it runs in.

A protocol is a set of callbacks (`IProtocol`); all it can do to the world goes through its provider
(`IProvider`). Neither knows which environment stands behind the other. What commands raise is in
`gradysim.protocol.errors`.
"""

from abc import ABC, abstractmethod
from random import Random
from typing import Any, Self

from gradysim.protocol.messages.communication import CommunicationCommand
from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry


class IProvider(ABC):
    """What a node offers to its protocol.

    Attributes:
        tracked_variables: Values that the protocol wants to be seen; environments show and record them under
            these names.
        run_name: `Study-#3.integrated`, where the run is one of several of a configuration; empty elsewhere.
            Files that a protocol writes are to have it in their names, or the next run overwrites them.
    """

    tracked_variables: dict[str, Any]
    run_name: str = ""

    @abstractmethod
    def send_communication_command(self, command: CommunicationCommand) -> None:
        """Hand a message, which is a text, to the node's radio. Nothing tells whether it arrives.

        Raises:
            CommunicationException: The message is no text or too long for the network, or there is no such
                destination or interface.
        """

    @abstractmethod
    def send_mobility_command(self, command: MobilityCommand) -> None:
        """Hand an order to the node's vehicle.

        Raises:
            MasslessMobilityException: It is no place in the scene or no speed, or the node cannot move. Other
                vehicles of prototype mode, which scripts add, have exceptions of their own.
        """

    @abstractmethod
    def schedule_timer(self, timer: str, timestamp: float) -> None:
        """Have `IProtocol.handle_timer(timer)` called at `timestamp`.

        Args:
            timer: Any name. Several timers of the same name may be pending.
            timestamp: Absolute time in seconds, of the same clock as `current_time`; not in the past.

        Raises:
            TimerException: The name is no text, or the time is past or no finite number.
        """

    @abstractmethod
    def cancel_timer(self, timer: str) -> None:
        """Forget every pending timer of that name; nothing happens if there is none.

        Raises:
            TimerException: The name is no text.
        """

    @abstractmethod
    def current_time(self) -> float:
        """Time in seconds. In a simulation: since its start."""

    @abstractmethod
    def get_id(self) -> int:
        """Id of this node, unique in the network."""

    @property
    def random(self) -> Random:
        """The node's own stream of random numbers: the same in every run with the same seed.

        A provider that does not say otherwise gets a stream that depends on the node's id alone.
        """
        stream: Random | None = getattr(self, "_default_random", None)
        if stream is None:
            stream = self._default_random = Random(self.get_id())
        return stream


class IProtocol(ABC):
    """The behaviour of one node: what it does when something happens.

    Subclasses take no constructor arguments. `provider` is there from `initialize` on, not yet in the
    constructor. The order of the nodes' `initialize` and `finish` is not part of the contract.

    Attributes:
        provider: The node that this protocol runs on.
    """

    provider: IProvider

    @classmethod
    def instantiate(cls, provider: IProvider) -> Self:
        """Make an instance that runs on `provider`; environments call this, not the constructor."""
        protocol = cls()
        protocol.provider = provider
        return protocol

    @abstractmethod
    def initialize(self) -> None:
        """Called once, before anything else happens to the node."""

    @abstractmethod
    def handle_timer(self, timer: str) -> None:
        """Called when a timer scheduled under the name `timer` is due."""

    @abstractmethod
    def handle_packet(self, message: str) -> None:
        """Called when the message of another node has been received."""

    @abstractmethod
    def handle_telemetry(self, telemetry: Telemetry) -> None:
        """Called periodically with the state of the vehicle."""

    @abstractmethod
    def finish(self) -> None:
        """Called once, after the last event of the run."""
