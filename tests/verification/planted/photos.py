"""Tolerance below the drift in wind: a photo each 5 s, unless the drone is 0.2 m away from its place."""

import math

from node import Node

from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand
from gradysim.protocol.messages.telemetry import Telemetry

_PLACE = (0.0, 0.0, 20.0)


class Drone(Node):
    """Hovers, and sends the number of each photo."""

    def initialize(self) -> None:
        self.number = 0
        self.due_s = 5.0
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(*_PLACE))

    def handle_telemetry(self, telemetry: Telemetry) -> None:
        if self.provider.current_time() < self.due_s:
            return
        self.due_s += 5
        if math.dist(telemetry.current_position, _PLACE) <= 0.2:
            self.number += 1
            self.count("photos")
            self.broadcast(f"photo {self.number}")


class Base(Node):
    """Counts photos."""

    def handle_packet(self, message: str) -> None:
        self.count("received")
