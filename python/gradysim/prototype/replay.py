"""Records runs of prototype mode for a replay."""

from collections.abc import Callable
from typing import Any, Final

from gradysim.protocol.messages.communication import CommunicationCommand, CommunicationCommandType
from gradysim.protocol.messages.mobility import MobilityCommand, MobilityCommandType
from gradysim.protocol.position import Position
from gradysim.replay.recorder import TableRecorder
from gradysim.replay.tables import BROADCAST, EVENT_KINDS, FRAME_KINDS, OUTCOMES
from gradysim.scenario.scenario import Scenario
from gradysim.simulator.handler.communication import CommunicationHandler
from gradysim.simulator.handler.mobility import MasslessMobilityHandler
from gradysim.simulator.node import Node

_DELIVERED, _LOST = OUTCOMES.index("delivered"), OUTCOMES.index("lost")
_KINDS: Final = {
    CommunicationCommandType.BROADCAST: FRAME_KINDS.index("broadcast"),
    CommunicationCommandType.SEND: FRAME_KINDS.index("unicast"),
}
_TIMER, _COMMAND = EVENT_KINDS.index("timer"), EVENT_KINDS.index("command")
_SAMPLING_S = 0.2
"""Interval between recorded positions of a vehicle whose path is not straight."""


class PrototypeRecorder(TableRecorder):
    """Records the actions of the handlers of a simulation.

    It replaces methods of single handlers and nodes by attributes of these objects. Others are not slowed
    down.
    """

    def watch_messages(self, communication: CommunicationHandler) -> None:
        """Record all messages."""
        communication.on_message = self._message_sent

    def watch_paths(self, mobility: MasslessMobilityHandler, scenario: Scenario) -> None:
        """Record the paths of nodes, from their commands; others at intervals."""
        for spec in scenario.nodes:
            self.path(spec.id, spec.initial_position, spec.initial_position, 0)
        handle_command, obey = mobility.handle_command, mobility.obey

        def record_and_handle(command: MobilityCommand, node: Node[Any]) -> None:
            handle_command(command, node)
            self.close_if_long()
            self.event(node.id, _COMMAND, _text_of(command))

        def record_and_obey(command: MobilityCommand, node: Node[Any]) -> None:
            obey(command, node)
            self.close_if_long()
            if node.id in mobility.targets:
                self.path(node.id, node.position, mobility.targets[node.id], mobility.speeds[node.id])

        for node_id, path in mobility.paths.items():
            mobility.paths[node_id] = self._sampled_path(node_id, path)
        # An attribute of the object hides the method of its class.
        setattr(mobility, "handle_command", record_and_handle)  # noqa: B010
        setattr(mobility, "obey", record_and_obey)  # noqa: B010

    def _sampled_path(self, node_id: int, path: Callable[[float], Position]) -> Callable[[float], Position]:
        """Return the same path, which records the node at intervals."""

        def position(time_s: float) -> Position:
            point = path(time_s)
            self.close_if_long()
            self.sampled(node_id, point, _SAMPLING_S)
            return point

        return position

    def watch_node(self, node: Node[Any]) -> None:
        """Record the callbacks of a node's protocol; call it before the protocol is made."""
        encapsulator = node.protocol_encapsulator
        for name in ("initialize", "handle_packet", "handle_telemetry", "finish"):
            cause = name.removeprefix("handle_")
            precede(encapsulator, name, lambda *_, cause=cause: self._begin(cause))
        precede(encapsulator, "handle_timer", lambda timer: self._timer_due(node.id, timer))

    def _begin(self, cause: str) -> None:
        self.close_if_long()
        self.cause = cause

    def _timer_due(self, node_id: int, timer: str) -> None:
        self._begin(f"timer {timer}")
        self.event(node_id, _TIMER, timer)

    def _message_sent(
        self,
        sender: int,
        command: CommunicationCommand,
        receivers: list[int],
        lost_at: list[int],
        out_of_range: int,
        delay_s: float,
    ) -> None:
        is_broadcast = command.command_type == CommunicationCommandType.BROADCAST
        self.message(
            sender,
            BROADCAST if is_broadcast else int(command.destination or 0),
            _KINDS[command.command_type],
            command.message,
            delay_s,
            dict.fromkeys(receivers, _DELIVERED) | dict.fromkeys(lost_at, _LOST),
            out_of_range,
        )


def precede(owner: Any, name: str, first: Callable[..., None]) -> None:
    """Call `first` before each call of that method of one object. Its attribute hides the class's method."""
    method = getattr(owner, name)

    def both(*arguments: Any) -> Any:
        first(*arguments)
        return method(*arguments)

    setattr(owner, name, both)


def _text_of(command: MobilityCommand) -> str:
    """Return a command in the format of the engine's recorder."""
    if command.command_type == MobilityCommandType.SET_SPEED:
        return f"fly at {command.param_1:g} m/s"
    point = ", ".join(f"{value:g}" for value in (command.param_1, command.param_2, command.param_3))
    unit = " m" if command.command_type == MobilityCommandType.GOTO_COORDS else ""
    return f"go to {point}{unit}"
