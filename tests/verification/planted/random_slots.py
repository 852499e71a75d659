"""Few random slots: candidates claim to be the leader in one of some slots, drawn once."""

from node import Node


class Candidate(Node):
    """Claims in its slot.

    Attributes:
        slots: Number of slots.
    """

    slots: int = 2

    def initialize(self) -> None:
        self.count("heard", 0)
        self.provider.schedule_timer("claim", 1 + 0.1 * self.provider.random.randrange(self.slots))

    def handle_timer(self, timer: str) -> None:
        self.broadcast("claim")

    def handle_packet(self, message: str) -> None:
        self.count("heard")
