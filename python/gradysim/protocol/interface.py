"""The interface between a protocol and the environment that runs it.

A protocol is a set of callbacks (`IProtocol`). It acts through its provider (`IProvider`). The exceptions
that commands raise are in `gradysim.protocol.errors`.
"""

from abc import ABC, abstractmethod
from random import Random
from typing import Any, Self, TypeGuard

from gradysim.protocol.errors import CommunicationException
from gradysim.protocol.messages.communication import CommunicationCommand
from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.position import Position


class IProvider(ABC):
    """What a node offers to its protocol.

    Attributes:
        tracked_variables: Values that environments show and record under these names.
        run_name: `Study-#3.integrated` if the run is one of several of a configuration; otherwise empty. Use
            it in the names of files that a protocol writes, or the next run overwrites them.
        has_telemetry: Whether the node calls `IProtocol.handle_telemetry`.
        initial_position: Where the node starts, (x, y, z) in meters, exactly; None if it is not known.
    """

    tracked_variables: dict[str, Any]
    run_name: str = ""
    has_telemetry: bool = True
    initial_position: Position | None = None

    @abstractmethod
    def send_communication_command(self, command: CommunicationCommand) -> None:
        """Hand a message to the node's radio. `IProtocol.handle_failed_message` may report that it failed.

        Raises:
            CommunicationException: The message is not a str or is too long for the network, or the
                destination or the interface does not exist.
        """

    @abstractmethod
    def send_mobility_command(self, command: MobilityCommand) -> None:
        """Hand a command to the node's vehicle.

        Raises:
            MasslessMobilityException: The target is not in the scene, the speed is not valid, or the node
                cannot move. Other mobility handlers of prototype mode have exceptions of their own.
        """

    @abstractmethod
    def schedule_timer(self, timer: str, timestamp: float) -> None:
        """Schedule a call of `IProtocol.handle_timer(timer)` at `timestamp`.

        Args:
            timer: Any name. Several timers of the same name may be pending.
            timestamp: Absolute time in seconds, of the same clock as `current_time`; not in the past.

        Raises:
            TimerException: The name is not a str, or the time is in the past or not a finite number.
        """

    @abstractmethod
    def cancel_timer(self, timer: str) -> None:
        """Cancel every pending timer of that name, if any. TimerException if the name is not a str."""

    @abstractmethod
    def current_time(self) -> float:
        """Time in seconds. In a simulation: since its start, by the clock of the node, which may drift."""

    @abstractmethod
    def get_id(self) -> int:
        """Id of this node, unique in the network."""

    def id_of(self, name: str) -> int:
        """Return the id of the node of that name.

        Args:
            name: As in the .ini file, `station` or `uavs[2]`, or as the script passed it to `add_node`.

        Raises:
            CommunicationException: No node has that name. The message has the nearest one. Environments
                outside of simulations may not know any.
        """
        raise CommunicationException(f"the names of the nodes are unknown here, got {name!r}; expected an id")

    @property
    def random(self) -> Random:
        """The node's own random stream: the same in every run with the same seed.

        The stream of this base class depends on the node's id alone.
        """
        stream: Random | None = getattr(self, "_default_random", None)
        if stream is None:
            stream = self._default_random = Random(self.get_id())
        return stream


class IProtocol(ABC):
    """The behavior of one node. `handle_telemetry`, `finish` and `handle_failed_message` are optional.

    The constructor takes no arguments and runs before `provider` is set; use the provider from `initialize`
    on. The order in which the nodes' `initialize` and `finish` are called is not specified.

    Attributes:
        provider: The node that this protocol runs on.
    """

    provider: IProvider

    @classmethod
    def instantiate(cls, provider: IProvider) -> Self:
        """Make an instance that runs on `provider`. Environments call this instead of the constructor."""
        protocol = cls()
        protocol.provider = provider
        return protocol

    @abstractmethod
    def initialize(self) -> None:
        """Called once, before every other callback."""

    @abstractmethod
    def handle_timer(self, timer: str) -> None:
        """Called when the timer `timer` is due."""

    @abstractmethod
    def handle_packet(self, message: str) -> None:
        """Called when a message of another node has been received."""

    def handle_telemetry(self, telemetry: Telemetry) -> None:  # noqa: B027 (optional)
        """Called periodically with the state of the vehicle. By default, it does nothing."""

    def finish(self) -> None:  # noqa: B027 (optional)
        """Called once, after the last event of the run. By default, it does nothing."""

    def handle_failed_message(  # noqa: B027 (optional)
        self, message: str, destination: int | None, reason: str
    ) -> None:
        """Called when a message of this node has failed, in integrated mode, if the class defines it.

        The medium of prototype mode gives a sender no feedback, so there it is never called. A message that
        is on the air counts as sent: only a missing acknowledgement tells that a unicast did not arrive, and
        nothing tells it of a broadcast.

        Args:
            message: The message.
            destination: The id to which it was sent; None for a broadcast.
            reason: Its outcome in the results: "queue_overflow" (the queue was full), "retry_limit" (no
                acknowledgement after the last retry), "channel_access_failure" (802.15.4: the channel was
                busy too often) or "out_of_range" (on a medium without radios).
        """


FAILED_MESSAGE_CALLBACK = "handle_failed_message"
"""A callback that protocols may leave out, also those that do not derive from `IProtocol`."""


def handles_failed_messages(protocol: object) -> bool:
    """Return whether the class of a protocol defines `handle_failed_message` itself."""
    method = getattr(type(protocol), FAILED_MESSAGE_CALLBACK, None)
    return method is not None and method is not IProtocol.handle_failed_message


_REQUIRED = ("initialize", "handle_timer", "handle_packet")

OPTIONAL_CALLBACKS = ("handle_telemetry", "finish")
"""Names of the callbacks that a protocol may leave out."""

CALLBACKS = (*_REQUIRED, *OPTIONAL_CALLBACKS)
"""Names of the callbacks of a protocol."""


def is_protocol_class(value: object) -> TypeGuard[type[IProtocol]]:
    """Return whether `value` is a class with the structure of a protocol, abstract or not.

    It need not derive from `IProtocol`: `gradys_embedded.protocol` has an interface of its own with the same
    methods. Such an interface itself, which declares the required callbacks as abstract, is not a protocol.
    """
    if not isinstance(value, type) or not all(
        callable(getattr(value, name, None)) for name in ("instantiate", *CALLBACKS)
    ):
        return False
    declared = (vars(value).get(name) for name in _REQUIRED)
    return not all(getattr(method, "__isabstractmethod__", False) for method in declared)
