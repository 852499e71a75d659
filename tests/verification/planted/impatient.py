"""Impatient request: a client looks for the answer one microsecond after its request."""

from node import Node


class Client(Node):
    """Asks the server, node 0, each second."""

    def initialize(self) -> None:
        self.has_answer = False
        self.set_timer_in("ask", 1)

    def handle_timer(self, timer: str) -> None:
        if timer == "look":
            self.count("answered" if self.has_answer else "gave up")
            return
        self.has_answer = False
        self.send("request", 0)
        self.set_timer_in("look", 1e-6)
        self.set_timer_in("ask", 1)

    def handle_packet(self, message: str) -> None:
        self.has_answer = True


class Server(Node):
    """Answers the client, node 1."""

    def handle_packet(self, message: str) -> None:
        self.send("answer", 1)
