"""Answers at once: all drones answer the same poll in the moment in which they hear it."""

from node import Node


class Base(Node):
    """Polls all drones each second, and counts their answers."""

    def initialize(self) -> None:
        self.set_timer_in("poll", 1)

    def handle_timer(self, timer: str) -> None:
        self.broadcast("poll")
        self.set_timer_in("poll", 1)

    def handle_packet(self, message: str) -> None:
        self.count("answers")


class Drone(Node):
    """Answers polls."""

    def handle_packet(self, message: str) -> None:
        if message == "poll":
            self.broadcast("here")
