"""What all protocols of the showcases have in common: one message, which is sent again and again."""

from typing import Annotated

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import BroadcastMessageCommand, SendMessageCommand


class CommunicationProtocolBase(IProtocol):
    """Sends its message at regular times, and also whenever the message or its target changes.

    The class itself has no message: a node with it neither sends nor answers.
    """

    start_time: Annotated[float, "s"] = 1.0
    """Nothing is sent before this time; 0 if it is negative."""
    stop_time: Annotated[float, "s"] = -1.0
    """Nothing is sent from this time on; negative: there is no such time."""
    send_interval: Annotated[float, "s"] = 1.0
    """Time between two messages, > 0."""
    hears: str = ""
    """Ids of the nodes whose messages count, "3 4"; "": those of all nodes."""

    def initialize(self) -> None:
        """Schedule the first message."""
        if not self.send_interval > 0:
            raise ValueError(f"send_interval is {self.send_interval} s, expected more than 0 s")
        self._message = ""
        self._target: int | None = None
        self._heard = ids_in(self.hears)
        self.provider.schedule_timer("send", max(self.start_time, 0.0))

    def handle_timer(self, timer: str) -> None:
        """Send the message, and schedule the next one."""
        if timer == "send":
            self._send()
            self.provider.schedule_timer("send", self.provider.current_time() + self.send_interval)

    def handle_packet(self, message: str) -> None:
        """Do nothing."""

    def _say(self, message: str, target: int | None) -> None:
        """From now on send `message` to `target`, or to all if that is None. Send it now if it is new."""
        if (message, target) != (self._message, self._target):
            self._message, self._target = message, target
            self._send()

    def _send(self) -> None:
        if self._message:
            self._send_to(self._target, self._message)

    def _send_to(self, target: int | None, message: str) -> bool:
        """Send a message to a node, or to all. Return False if it is too early or too late for that."""
        now = self.provider.current_time()
        if now < self.start_time or 0 <= self.stop_time <= now:
            return False
        command = BroadcastMessageCommand(message) if target is None else SendMessageCommand(message, target)
        self.provider.send_communication_command(command)
        return True

    def _ignores(self, sender: int) -> bool:
        return bool(self._heard) and sender not in self._heard

    def _track_load(self, load: int) -> None:
        self.provider.tracked_variables["data_load"] = load


def ids_in(text: str) -> list[int]:
    """Return the ids of nodes in a parameter such as "3 4". ValueError if they are not integers."""
    return [int(word) for word in text.split()]
