"""No retry: an order that all drones must get is sent once, and none of them confirms it."""

from node import Node


class Station(Node):
    """Orders all drones to land."""

    def initialize(self) -> None:
        self.set_timer_in("order", 1)

    def handle_timer(self, timer: str) -> None:
        self.broadcast("land")


class Drone(Node):
    """Obeys."""

    def initialize(self) -> None:
        self.provider.tracked_variables["landed"] = 0

    def handle_packet(self, message: str) -> None:
        self.provider.tracked_variables["landed"] = 1
