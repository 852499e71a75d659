"""Base of the planted protocols: a node that does nothing."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand
from gradysim.protocol.messages.telemetry import Telemetry


class Node(IProtocol):
    """Handlers that do nothing, and two ways to send."""

    def initialize(self) -> None: ...

    def handle_timer(self, timer: str) -> None: ...

    def handle_packet(self, message: str) -> None: ...

    def handle_telemetry(self, telemetry: Telemetry) -> None: ...

    def finish(self) -> None: ...

    def broadcast(self, message: str) -> None:
        self.provider.send_communication_command(BroadcastMessageCommand(message))

    def send(self, message: str, destination: int) -> None:
        self.provider.send_communication_command(SendMessageCommand(message, destination))

    def count(self, variable: str, amount: float = 1) -> None:
        """Add to a tracked variable."""
        tracked = self.provider.tracked_variables
        tracked[variable] = tracked.get(variable, 0) + amount

    def set_timer_in(self, timer: str, delay_s: float) -> None:
        self.provider.schedule_timer(timer, self.provider.current_time() + delay_s)
