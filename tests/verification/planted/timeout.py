"""Timeout shorter than the delay: a client gives up 10 ms after its request."""

from node import Node


class Client(Node):
    """Asks the server, node 0, each second, and ignores late answers."""

    def initialize(self) -> None:
        self.waits = False
        self.set_timer_in("ask", 1)

    def handle_timer(self, timer: str) -> None:
        if timer == "give up":
            self.waits = False
            return
        self.waits = True
        self.send("request", 0)
        self.set_timer_in("give up", 0.01)
        self.set_timer_in("ask", 1)

    def handle_packet(self, message: str) -> None:
        if self.waits:
            self.count("answered")
            self.waits = False


class Server(Node):
    """Answers the client, node 1, with a map of 1,500 B."""

    def handle_packet(self, message: str) -> None:
        self.send("map".ljust(1500), 1)
