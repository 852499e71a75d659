"""Clock synchronization without delay: the drone takes the time in a message for the time now."""

from node import Node


class Station(Node):
    """Broadcasts its time each second."""

    def initialize(self) -> None:
        self.set_timer_in("tell time", 1)

    def handle_timer(self, timer: str) -> None:
        self.broadcast(f"{self.provider.current_time():.9f}")
        self.set_timer_in("tell time", 1)


class Drone(Node):
    """Tracks the error of its time in seconds."""

    def initialize(self) -> None:
        self.provider.tracked_variables["error"] = 0.0

    def handle_packet(self, message: str) -> None:
        self.provider.tracked_variables["error"] = self.provider.current_time() - float(message)
