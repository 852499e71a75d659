"""Lock-step timers with a number in each name."""

from node import Node


class Drone(Node):
    """Sends a heartbeat each second, and counts those of the others."""

    def initialize(self) -> None:
        self.number = 0
        self.set_timer_in("beat-0", 1)

    def handle_timer(self, timer: str) -> None:
        self.broadcast("heartbeat")
        self.number += 1
        self.set_timer_in(f"beat-{self.number}", 1)

    def handle_packet(self, message: str) -> None:
        self.count("heard")
