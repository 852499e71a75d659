"""Hidden terminals: two sensors that do not hear each other report to a sink between them."""

from node import Node


class Sensor(Node):
    """Broadcasts a report of 500 B each 2 ms on average, at random times."""

    def initialize(self) -> None:
        self.number = 0
        self.set_timer_in("report", self.provider.random.uniform(0, 0.002))

    def handle_timer(self, timer: str) -> None:
        self.number += 1
        self.broadcast(f"{self.provider.get_id()} {self.number}".ljust(500))
        self.set_timer_in("report", self.provider.random.uniform(0.001, 0.003))


class Sink(Node):
    """Tracks which share of the reports has arrived."""

    def initialize(self) -> None:
        self.received = 0
        self.last: dict[str, int] = {}

    def handle_packet(self, message: str) -> None:
        sender, number = message.split()
        self.received += 1
        self.last[sender] = int(number)
        self.provider.tracked_variables["share"] = self.received / sum(self.last.values())
