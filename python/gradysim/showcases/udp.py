"""UdpBasicApp: a source of messages, for the showcases of INET."""

from typing import Annotated

from gradysim.showcases.communication import CommunicationProtocolBase, ids_in


class UdpBasicApp(CommunicationProtocolBase):
    """Sends messages at regular times, each to one of its destinations, which it draws.

    Tracked variables:
        sent: Messages handed to the radio.
        received: Messages that have arrived.
    """

    start_time: Annotated[float, "s"] = 0.0
    destinations: str = ""
    """Ids of the nodes that messages go to: "3 4"."""
    message_length: Annotated[int, "B"] = 100
    """Characters of a message, which are bytes."""

    def initialize(self) -> None:
        """Start with counts of 0."""
        super().initialize()
        self._targets = ids_in(self.destinations)
        self._message = "x" * self.message_length
        self._sent = self._received = 0
        self._track()

    def handle_packet(self, message: str) -> None:
        """Count a message."""
        self._received += 1
        self._track()

    def _send(self) -> None:
        if self._targets and self._send_to(self.provider.random.choice(self._targets), self._message):
            self._sent += 1
            self._track()

    def _track(self) -> None:
        self.provider.tracked_variables["sent"] = self._sent
        self.provider.tracked_variables["received"] = self._received
