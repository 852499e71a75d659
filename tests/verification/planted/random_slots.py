"""Few random slots: candidates claim to be the leader in one of two slots, drawn once."""

from node import Node


class Candidate(Node):
    """Claims in its slot."""

    def initialize(self) -> None:
        self.provider.schedule_timer("claim", 1 + 0.1 * self.provider.random.randrange(2))

    def handle_timer(self, timer: str) -> None:
        self.broadcast("claim")

    def handle_packet(self, message: str) -> None:
        self.count("heard")
