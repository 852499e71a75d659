"""Encapsulator of integrated mode: one Python protocol on one node of the compiled engine.

The engine calls the five methods of the *protocol* by name, so that plugins can replace them; these calls do
not pass through this file. The methods of the provider are the engine's own bound methods, so that each costs
one call.
"""

from collections.abc import Callable, Mapping, Sequence
from random import Random
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from gradysim.encapsulator.interface import IEncapsulator
from gradysim.encapsulator.random_stream import Purpose, RandomStream
from gradysim.encapsulator.tracked_variables import CheckedProvider
from gradysim.encapsulator.validation import addressed_by_id, geo_target, id_of_name
from gradysim.protocol.errors import add_protocol_note
from gradysim.protocol.interface import IProtocol, IProvider, handles_failed_messages
from gradysim.protocol.messages.communication import CommunicationCommand
from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    MobilityCommand,
    MobilityCommandType,
)
from gradysim.protocol.position import Position

if TYPE_CHECKING:
    from gradysim._netsim import Node

T = TypeVar("T", bound=IProtocol)

_SAME_IN_THE_ENGINE = sorted(
    IProvider.__abstractmethods__ - {"send_communication_command", "send_mobility_command"}
)


def _forwarding(attribute: str, method: str) -> Callable[..., Any]:
    """Return a method that passes its arguments to `method` of an attribute."""

    def call(self: Any, *arguments: Any) -> Any:
        return getattr(getattr(self, attribute), method)(*arguments)

    return call


def _sending_by_id(
    send: Callable[[CommunicationCommand], None], ids_by_name: Mapping[str, int]
) -> Callable[[CommunicationCommand], None]:
    """Return a function that sends to ids, also if a command has the name. It is called for each message."""

    def send_communication_command(command: CommunicationCommand) -> None:
        if isinstance(getattr(command, "destination", None), str):
            command = addressed_by_id(command, ids_by_name)
        send(command)

    return send_communication_command


class NetsimProvider(CheckedProvider):
    """Provider whose calls go to the engine. They raise the exceptions of `gradysim.protocol.errors`.

    Attributes:
        handlers: Handlers that watch the run, by label; for extensions.
        mode: Name of the mode, for messages.
    """

    mode = "integrated mode"

    def __init__(
        self,
        node: "Node",
        *,
        seed: int,
        reference_coordinates: Position,
        nodes: Sequence["Node"] = (),
        handlers: Mapping[str, Any] | None = None,
        ids_by_name: Mapping[str, int] | None = None,
        steer: Callable[[MobilityCommand], None] | None = None,
    ) -> None:
        """Serve the protocol of `node`. `nodes` are all of the network, for `node_positions`.

        The random numbers follow from the run's seed and the node's id. `reference_coordinates` are (latitude
        deg, longitude deg, altitude m) of the scene's origin. `handlers` watch the run, by label.
        `ids_by_name` are those of all nodes. `steer` carries out mobility commands instead of the engine.
        """
        self._node = node
        self._nodes = nodes
        self.handlers = {} if handlers is None else handlers
        self._reference_coordinates = reference_coordinates
        self._random = RandomStream(seed, node.id, Purpose.PROTOCOL)
        self.tracked_variables: dict[str, Any] = {}
        # Each attribute hides the method of the class: a call goes straight to the engine.
        for name in _SAME_IN_THE_ENGINE:
            setattr(self, name, getattr(node, name))
        self._ids_by_name = {} if ids_by_name is None else ids_by_name
        self._send = _sending_by_id(node.send_communication_command, self._ids_by_name)
        setattr(self, "send_communication_command", self._send)  # noqa: B010 (hides a method, as above)
        if steer is not None:
            setattr(self, "send_mobility_command", steer)  # noqa: B010 (hides a method, as above)

    def id_of(self, name: str) -> int:
        """Return the id of the node of that name. CommunicationException if there is none."""
        return id_of_name(name, self._ids_by_name)

    @property
    def random(self) -> Random:
        """The protocol's own random numbers: the same for the same seed and node, in both modes."""
        return self._random

    # The abstract methods of IProvider. Only mobility commands without an autopilot get here; other calls go
    # to the attributes of the instance, which __init__ sets. These methods are for calls through super().

    schedule_timer = _forwarding("_node", "schedule_timer")
    cancel_timer = _forwarding("_node", "cancel_timer")
    current_time = _forwarding("_node", "current_time")
    get_id = _forwarding("_node", "get_id")

    def send_communication_command(self, command: CommunicationCommand) -> None:
        """Send a message to the id of its destination, also if the command has the name."""
        self._send(command)

    def send_mobility_command(self, command: MobilityCommand) -> None:
        """Steer the node. Geographic coordinates are taken relative to the origin of the scene."""
        if getattr(command, "command_type", None) == MobilityCommandType.GOTO_GEO_COORDS:
            target = geo_target(command, self.get_id(), self._reference_coordinates)
            command = GotoCoordsMobilityCommand(*target)
        self._node.send_mobility_command(command)

    def node_positions(self) -> dict[int, Position]:
        """Return the current position (x, y, z) in meters of every node, by id. For extensions.

        Raise RuntimeError if the provider was made without the nodes.
        """
        if not self._nodes:
            raise RuntimeError("the positions of the nodes are unknown: the provider was made without them")
        return {node.id: node.position for node in self._nodes}


class NetsimEncapsulator(IEncapsulator[T], Generic[T]):
    """Puts a protocol on a node of the engine, and adds a note to the exceptions that it raises."""

    def __init__(self, node: "Node", provider: NetsimProvider) -> None:
        """Prepare `node`, which is that of the provider."""
        self._node = node
        self.provider = provider

    def encapsulate(self, protocol: type[T]) -> None:
        """Make the protocol and hand it to the node."""
        self._class = protocol
        try:
            self.protocol = protocol.instantiate(self.provider)
        except BaseException as failure:
            self._note(failure, "__init__")
            raise
        self._node.set_protocol(self.protocol, self._note, handles_failed_messages(self.protocol))

    # The engine calls the protocol itself. These methods are for handlers that call the protocol of a node
    # through its encapsulator, as in prototype mode.

    initialize = _forwarding("protocol", "initialize")
    handle_timer = _forwarding("protocol", "handle_timer")
    handle_packet = _forwarding("protocol", "handle_packet")
    handle_telemetry = _forwarding("protocol", "handle_telemetry")
    finish = _forwarding("protocol", "finish")

    def _note(self, failure: BaseException, callback: str) -> None:
        add_protocol_note(
            failure,
            node_id=self._node.id,
            protocol=self._class,
            time_s=self._node.current_time(),
            callback=callback,
        )
