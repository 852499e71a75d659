"""A near beacon and a far one send almost at the same time. The near one is so strong that it survives."""

from node import Node


class Beacon(Node):
    """Broadcasts ten times a second, from `first_send` on.

    Attributes:
        first_send: Time of the first broadcast in s.
    """

    first_send: float = 1.0

    def initialize(self) -> None:
        self.provider.schedule_timer("beacon", self.first_send)

    def handle_timer(self, timer: str) -> None:
        self.broadcast("near" if self.provider.get_id() == 1 else "far")
        self.set_timer_in("beacon", 0.1)


class Base(Node):
    """Counts the broadcasts of the near beacon."""

    def initialize(self) -> None:
        self.count("near", 0)

    def handle_packet(self, message: str) -> None:
        if message == "near":
            self.count("near")
