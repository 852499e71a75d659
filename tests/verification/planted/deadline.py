"""Deadline below the delay under load: a client asks once, and does not wait longer than 5 ms."""

from node import Node


class Station(Node):
    """Loads the channel with 1,000 B each 20 ms on average."""

    def initialize(self) -> None:
        self.handle_timer("load")

    def handle_timer(self, timer: str) -> None:
        self.broadcast("load".ljust(1000))
        self.set_timer_in("load", self.provider.random.uniform(0.01, 0.03))


class Client(Node):
    """Asks the server, node 0, ten times a second, and ignores late answers."""

    def initialize(self) -> None:
        self.waits = False
        self.number = 0
        self.set_timer_in("ask", 0.1)

    def handle_timer(self, timer: str) -> None:
        if timer != "ask":
            self.waits = False
            return
        self.number += 1
        self.waits = True
        self.send(f"request {self.number}", 0)
        self.set_timer_in(f"deadline-{self.number}", 0.005)
        self.set_timer_in("ask", 0.1)

    def handle_packet(self, message: str) -> None:
        if self.waits and message == f"answer {self.number}":
            self.count("answered")
            self.waits = False


class Server(Node):
    """Answers requests of the client, node 1, and ignores the load."""

    def handle_packet(self, message: str) -> None:
        if message.startswith("request"):
            self.send(message.replace("request", "answer"), 1)
