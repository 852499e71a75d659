"""Encapsulator of prototype mode: the commands of a protocol go to the handlers of the simulator."""

import logging
from collections.abc import Mapping
from random import Random
from typing import Any

from gradysim.encapsulator.interface import IEncapsulator
from gradysim.encapsulator.random_stream import Purpose, RandomStream
from gradysim.encapsulator.tracked_variables import CheckedProvider
from gradysim.encapsulator.validation import id_of_name
from gradysim.protocol.errors import add_protocol_note
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import CommunicationCommand
from gradysim.protocol.messages.mobility import MobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry
from gradysim.protocol.position import Position

_logger = logging.getLogger(__name__)


class PythonProvider(CheckedProvider):
    """Provider that passes calls to the handlers labeled "communication", "mobility" and "timer".

    A command without a handler is dropped with a warning. Without a timer handler the time is always 0.

    Attributes:
        node: The protocol's node. Its optional attribute `seed` is the seed of the run; the default is 0.
        handlers: Every handler of the simulation, by label.
        communication_handler: The handler labeled "communication", or None.
        mobility_handler: The same for "mobility".
        timer_handler: The same for "timer".
        mode: Name of the mode, for messages.
    """

    mode = "prototype mode"

    def __init__(self, node: Any, **handlers: Any) -> None:
        self.node = node
        self.handlers: Mapping[str, Any] = handlers
        self.tracked_variables: dict[str, Any] = {}
        self.communication_handler = handlers.get("communication")
        self.mobility_handler = handlers.get("mobility")
        self.timer_handler = handlers.get("timer")
        self._random: Random | None = None

    def send_communication_command(self, command: CommunicationCommand) -> None:
        """Send a message. The handler raises CommunicationException for an invalid command."""
        if self.communication_handler is None:
            self._warn_without("communication", "a message was not sent")
        else:
            self.communication_handler.handle_command(command, self.node)

    def send_mobility_command(self, command: MobilityCommand) -> None:
        """Steer the vehicle. The handler raises MobilityException for an invalid command."""
        if self.mobility_handler is None:
            self._warn_without("mobility", "a command was not carried out")
        else:
            self.mobility_handler.handle_command(command, self.node)

    def schedule_timer(self, timer: str, timestamp: float) -> None:
        """Set a timer. The handler raises TimerException for a time in the past."""
        if self.timer_handler is None:
            self._warn_without("timer", f"the timer {timer!r} was not set")
        else:
            self.timer_handler.set_timer(timer, timestamp, self.node)

    def cancel_timer(self, timer: str) -> None:
        """Cancel every pending timer of that name."""
        if self.timer_handler is None:
            self._warn_without("timer", f"the timer {timer!r} was not canceled")
        else:
            self.timer_handler.cancel_timer(timer, self.node)

    def current_time(self) -> float:
        """Return the simulated time in seconds."""
        if self.timer_handler is None:
            self._warn_without("timer", "the time is unknown")
            return 0
        now_s: float = self.timer_handler.get_current_time()
        return now_s

    def get_id(self) -> int:
        """Return the id of the node."""
        node_id: int = self.node.id
        return node_id

    def id_of(self, name: str) -> int:
        """Return the id of the node of that name. CommunicationException if there is none."""
        return id_of_name(name, getattr(self.node, "ids_by_name", {}))

    @property
    def random(self) -> Random:
        """The node's stream in this run, the same in every run with the same seed."""
        if self._random is None:
            self._random = RandomStream(getattr(self.node, "seed", 0), self.node.id, Purpose.PROTOCOL)
        return self._random

    def node_positions(self) -> dict[int, Position]:
        """Return the current position (x, y, z) in meters of every node, by id. For extensions.

        Raise RuntimeError if there is no mobility handler.
        """
        nodes: Mapping[int, Any] | None = getattr(self.handlers.get("mobility"), "nodes", None)
        if nodes is None:
            raise RuntimeError(
                "the positions of the nodes are unknown: the simulation has no mobility handler"
            )
        return {node_id: node.position for node_id, node in nodes.items()}

    def _warn_without(self, label: str, consequence: str) -> None:
        _logger.warning("Node %s has no %s handler: %s", self.node.id, label, consequence)


class PythonEncapsulator(IEncapsulator[IProtocol]):
    """Calls the protocol, and adds a note with node, time and callback to the exceptions that it raises."""

    def __init__(self, node: Any, **handlers: Any) -> None:
        self.node = node
        self.provider = PythonProvider(node, **handlers)

    def encapsulate(self, protocol: type[IProtocol]) -> None:
        """Make an instance of the protocol."""
        try:
            self.protocol = protocol.instantiate(self.provider)
        except BaseException as exception:
            self._note(exception, "__init__", protocol)
            raise

    def initialize(self) -> None:
        """Run the protocol's `initialize`."""
        try:
            self.protocol.initialize()
        except BaseException as exception:
            self._note(exception, "initialize", type(self.protocol))
            raise

    def handle_timer(self, timer: str) -> None:
        """Run the protocol's `handle_timer`."""
        try:
            self.protocol.handle_timer(timer)
        except BaseException as exception:
            self._note(exception, "handle_timer", type(self.protocol))
            raise

    def handle_packet(self, message: str) -> None:
        """Run the protocol's `handle_packet`."""
        try:
            self.protocol.handle_packet(message)
        except BaseException as exception:
            self._note(exception, "handle_packet", type(self.protocol))
            raise

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        """Run the protocol's `handle_telemetry`."""
        try:
            self.protocol.handle_telemetry(telemetry)
        except BaseException as exception:
            self._note(exception, "handle_telemetry", type(self.protocol))
            raise

    def finish(self) -> None:
        """Run the protocol's `finish`."""
        try:
            self.protocol.finish()
        except BaseException as exception:
            self._note(exception, "finish", type(self.protocol))
            raise

    def _note(self, exception: BaseException, callback: str, protocol: type[IProtocol]) -> None:
        timer = self.provider.handlers.get("timer")
        add_protocol_note(
            exception,
            node_id=self.node.id,
            protocol=protocol,
            time_s=timer.get_current_time() if timer is not None else 0.0,
            callback=callback,
        )
