"""Lock-step timers: all drones send their heartbeat at the same instants."""

from node import Node


class Drone(Node):
    """Counts the heartbeats of the others."""

    def initialize(self) -> None:
        self.set_timer_in("heartbeat", 1)

    def handle_timer(self, timer: str) -> None:
        self.broadcast("heartbeat")
        self.set_timer_in("heartbeat", 1)

    def handle_packet(self, message: str) -> None:
        self.count("heard")
