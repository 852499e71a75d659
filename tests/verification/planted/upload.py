"""Unbounded queue: a logger sends all of its readings at once."""

from node import Node


class Logger(Node):
    """Sends 150 readings to the sink, which is node 0."""

    def initialize(self) -> None:
        self.set_timer_in("upload", 1)

    def handle_timer(self, timer: str) -> None:
        for reading in range(150):
            self.send(f"reading {reading}", 0)


class Sink(Node):
    """Counts readings."""

    def handle_packet(self, message: str) -> None:
        self.count("collected")
