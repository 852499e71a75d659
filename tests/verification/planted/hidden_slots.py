"""Slots without a common clock, between nodes that do not hear each other."""

from node import Node


class Sensor(Node):
    """Sends each 20 ms by its own clock; the second sensor is 10 ms later."""

    size: int = 1300

    def initialize(self) -> None:
        self.provider.schedule_timer("send", 0.01 * self.provider.get_id())

    def handle_timer(self, timer: str) -> None:
        self.broadcast("report".ljust(self.size))
        self.set_timer_in("send", 0.02)


class Sink(Node):
    """Counts reports."""

    def handle_packet(self, message: str) -> None:
        self.count("reports")
