"""Perfect clock: a drone listens for 5 ms each 10 s, when by its own clock the station sends."""

from node import Node

_PERIOD_S = 10
_WINDOW_S = 0.005


class Station(Node):
    """Sends in the middle of each window."""

    def initialize(self) -> None:
        self.number = 0
        self.handle_timer("send")

    def handle_timer(self, timer: str) -> None:
        if self.number:
            self.broadcast("news")
        self.number += 1
        self.provider.schedule_timer("send", self.number * _PERIOD_S + _WINDOW_S / 2)


class Drone(Node):
    """Ignores what arrives while it sleeps."""

    def initialize(self) -> None:
        self.number = 1
        self.is_awake = False
        self.provider.schedule_timer("wake", _PERIOD_S)

    def handle_timer(self, timer: str) -> None:
        self.is_awake = timer == "wake"
        if self.is_awake:
            self.provider.schedule_timer("sleep", self.number * _PERIOD_S + _WINDOW_S)
            self.number += 1
            self.provider.schedule_timer("wake", self.number * _PERIOD_S)

    def handle_packet(self, message: str) -> None:
        if self.is_awake:
            self.count("news")
