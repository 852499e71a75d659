"""Assumption of order: messages of two senders arrive in the order in which they were sent."""

from node import Node


class Sender(Node):
    """Sends a message of its kind each second."""

    kind: str = ""
    first_send: float = 1.0
    """Time of the first message in seconds."""
    payload_bytes: int = 20

    def initialize(self) -> None:
        self.number = 0
        self.provider.schedule_timer("send", self.first_send)

    def handle_timer(self, timer: str) -> None:
        self.number += 1
        self.broadcast(f"{self.kind} {self.number}".ljust(self.payload_bytes, "."))
        self.provider.schedule_timer("send", self.first_send + self.number)


class Base(Node):
    """Keeps a photo if the target on it has been reported before."""

    def initialize(self) -> None:
        self.found = 0

    def handle_packet(self, message: str) -> None:
        kind, number = message.rstrip(".").split()
        if kind == "found":
            self.found = int(number)
        elif kind == "photo" and self.found == int(number):
            self.count("kept")
