"""A station broadcasts ten corrections of the position a second, and a drone relies on each of them.

The flaw is where the drone is: at the edge of the range, behind a wall, or above the station.
"""

from node import Node


class Station(Node):
    """Broadcasts corrections."""

    def initialize(self) -> None:
        self.set_timer_in("correct", 0.1)

    def handle_timer(self, timer: str) -> None:
        self.broadcast("correction")
        self.set_timer_in("correct", 0.1)


class Drone(Node):
    """Counts corrections."""

    def handle_packet(self, message: str) -> None:
        self.count("corrections")
