"""Glue between one Python protocol and one node of the compiled engine.

`gradysim.integrated` makes one encapsulator per node. The engine calls the five methods of the *protocol*
by their names, so that plugins which re-bind them are honoured; it never comes through this file. In the
other direction the calls of the provider are the engine's own bound methods, so that what a protocol asks
for costs one call.
"""

from collections.abc import Callable, Mapping, Sequence
from random import Random
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from gradysim.encapsulator.checked_provider import CheckedProvider
from gradysim.encapsulator.failure import add_protocol_note
from gradysim.encapsulator.geo_target import geo_target
from gradysim.encapsulator.interface import IEncapsulator
from gradysim.encapsulator.random_stream import Purpose, RandomStream
from gradysim.encapsulator.wrong_arguments import reword_wrong_arguments
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import CommunicationCommand
from gradysim.protocol.messages.mobility import (
    GotoCoordsMobilityCommand,
    MobilityCommand,
    MobilityCommandType,
)
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.position import Position

if TYPE_CHECKING:
    from gradysim._netsim import Node

T = TypeVar("T", bound=IProtocol)

_SAME_IN_THE_ENGINE = (
    "send_communication_command",
    "schedule_timer",
    "cancel_timer",
    "current_time",
    "get_id",
)


class NetsimProvider(CheckedProvider):
    """What a protocol may ask of its node, answered by the engine.

    Errors are those of `gradysim.protocol.errors`: a timer in the past, a destination that does not exist, a
    message over the MTU.

    Attributes:
        handlers: Handlers that watch the run, by their labels; for extensions.
        mode: Name of the mode, for people.
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
        steer: Callable[[MobilityCommand], None] | None = None,
    ) -> None:
        """Serve the protocol of `node`.

        Args:
            node: The engine's node.
            seed: Seed of the run; the protocol's random numbers follow from it and the node's id.
            reference_coordinates: (latitude deg, longitude deg, altitude m) of the scene's origin.
            nodes: All nodes of the network, for extensions that look around.
            handlers: Handlers that watch the run, by their labels.
            steer: Carries out mobility commands in the place of the engine.
        """
        self._node = node
        self._nodes = nodes
        self.handlers = {} if handlers is None else handlers
        self._reference_coordinates = reference_coordinates
        self._random = RandomStream(seed, node.id, Purpose.PROTOCOL)
        self.tracked_variables: dict[str, Any] = {}
        # Each hides the method of the class that has its name: a call goes straight to the engine.
        for name in _SAME_IN_THE_ENGINE:
            setattr(self, name, getattr(node, name))
        if steer is not None:
            setattr(self, "send_mobility_command", steer)  # noqa: B010 (as above, it hides a method)

    @property
    def random(self) -> Random:
        """The protocol's own random numbers: the same for the same seed and node, in both modes."""
        return self._random

    # What IProvider asks for by name. But for mobility commands that no autopilot carries out, calls do not
    # get here: they go to the attributes of the instance, which __init__ sets. These do the same for whoever
    # calls them by the class, as super() does.

    def send_communication_command(self, command: CommunicationCommand) -> None:
        """Hand a message to the node's network interface."""
        self._node.send_communication_command(command)

    def send_mobility_command(self, command: MobilityCommand) -> None:
        """Steer the node. Geographic coordinates are taken relative to the origin of the scene."""
        if getattr(command, "command_type", None) == MobilityCommandType.GOTO_GEO_COORDS:
            target = geo_target(command, self.get_id(), self._reference_coordinates)
            command = GotoCoordsMobilityCommand(*target)
        self._node.send_mobility_command(command)

    def schedule_timer(self, timer: str, timestamp: float) -> None:
        """Have `handle_timer(timer)` called at `timestamp`, in seconds of simulated time."""
        self._node.schedule_timer(timer, timestamp)

    def cancel_timer(self, timer: str) -> None:
        """Cancel every pending timer of this name."""
        self._node.cancel_timer(timer)

    def current_time(self) -> float:
        """Return the simulated time in seconds."""
        return self._node.current_time()

    def get_id(self) -> int:
        """Return the node's id, 0 to n-1."""
        return self._node.get_id()

    def node_positions(self) -> dict[int, Position]:
        """Return where every node is now, (x, y, z) in metres by id.

        For extensions: protocols have no business knowing.
        """
        if not self._nodes:
            raise RuntimeError("the positions of the nodes are unknown: the provider was made without them")
        return {node.id: node.position for node in self._nodes}


class NetsimEncapsulator(IEncapsulator[T], Generic[T]):
    """Puts a protocol on a node of the engine and says where a failure in it happened."""

    def __init__(
        self,
        node: "Node",
        *,
        seed: int,
        reference_coordinates: Position = (0.0, 0.0, 0.0),
        nodes: Sequence["Node"] = (),
        handlers: Mapping[str, Any] | None = None,
        steer: Callable[[MobilityCommand], None] | None = None,
    ) -> None:
        """Prepare `node`; the arguments are those of `NetsimProvider`."""
        self._node = node
        self.provider = NetsimProvider(
            node,
            seed=seed,
            reference_coordinates=reference_coordinates,
            nodes=nodes,
            handlers=handlers,
            steer=steer,
        )

    def encapsulate(self, protocol: type[T]) -> None:
        """Make the protocol and hand it to the node."""
        self._class = protocol
        try:
            self.protocol = protocol.instantiate(self.provider)
        except BaseException as failure:
            self._note(failure, "__init__")
            raise
        self._node.set_protocol(self.protocol, self._note)

    # What IEncapsulator asks for by name. The engine calls the protocol itself; these are for handlers that
    # call a node's protocol by its encapsulator, as in prototype mode.

    def initialize(self) -> None:
        """Call the protocol's method of this name, as do the four below."""
        self.protocol.initialize()

    def handle_timer(self, timer: str) -> None:
        """A timer is due."""
        self.protocol.handle_timer(timer)

    def handle_packet(self, message: str) -> None:
        """A message has arrived."""
        self.protocol.handle_packet(message)

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        """The node's position is known anew."""
        self.protocol.handle_telemetry(telemetry)

    def finish(self) -> None:
        """The run is over."""
        self.protocol.finish()

    def _note(self, failure: BaseException, callback: str) -> None:
        reword_wrong_arguments(failure)
        add_protocol_note(
            failure,
            node_id=self._node.id,
            protocol=self._class,
            time_s=self._node.current_time(),
            callback=callback,
        )
