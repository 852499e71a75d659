"""One hop: each drone reports to the base directly, however far away it is."""

from node import Node


class Drone(Node):
    """Reports to the base, node 0, each second, at a random time."""

    def initialize(self) -> None:
        self.set_timer_in("report", self.provider.random.uniform(0, 1))

    def handle_timer(self, timer: str) -> None:
        self.send("report", 0)
        self.set_timer_in("report", 1)


class Base(Node):
    """Counts reports."""

    def handle_packet(self, message: str) -> None:
        self.count("reports")
