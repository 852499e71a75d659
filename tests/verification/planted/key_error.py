"""Exception after a loss: the base looks up a drone whose hello it may have missed."""

from node import Node


class Drone(Node):
    """Says hello in one of two slots, and reports each second from then on."""

    def initialize(self) -> None:
        self.provider.schedule_timer("hello", 1 + 0.1 * self.provider.random.randrange(2))

    def handle_timer(self, timer: str) -> None:
        self.broadcast(f"{timer} {self.provider.get_id()}")
        self.set_timer_in("report", 1 + 0.001 * self.provider.get_id())


class Base(Node):
    """Counts the reports of each drone that said hello."""

    def initialize(self) -> None:
        self.reports: dict[str, int] = {}

    def handle_packet(self, message: str) -> None:
        kind, drone = message.split()
        if kind == "hello":
            self.reports[drone] = 0
        self.reports[drone] += 1
        self.count("reports")
