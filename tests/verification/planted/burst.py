"""Bursts larger than the queue: each 20 s, a logger sends 150 readings at once."""

from node import Node


class Logger(Node):
    """Sends its readings to the sink, which is node 0."""

    def initialize(self) -> None:
        self.set_timer_in("upload", 1)

    def handle_timer(self, timer: str) -> None:
        for _ in range(150):
            self.send("reading", 0)
        self.set_timer_in("upload", 20)
