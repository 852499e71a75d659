"""Setpoints from a laptop to a drone, ten per second, alone or beside datagrams from the same laptop."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import SendMessageCommand

SETPOINT_S = 0.1
DATAGRAM_B = 1000


class Laptop(IProtocol):
    """Sends setpoints at the multiples of their interval, or as soon after them as its computer can."""

    datagram_interval: float = 0.0

    def initialize(self) -> None:
        self.due = {"setpoint": 1.0} | ({"datagram": 1.0} if self.datagram_interval else {})
        for timer, time_s in self.due.items():
            self.provider.schedule_timer(timer, time_s)

    def handle_timer(self, timer: str) -> None:
        message = timer.ljust(DATAGRAM_B if timer == "datagram" else 0)
        self.provider.send_communication_command(SendMessageCommand(message, self.provider.id_of("drone[0]")))
        self.due[timer] += self.datagram_interval if timer == "datagram" else SETPOINT_S
        self.provider.schedule_timer(timer, max(self.due[timer], self.provider.current_time()))

    def handle_packet(self, message: str) -> None: ...


class Drone(IProtocol):
    """Notes when setpoints arrive."""

    def initialize(self) -> None:
        self.provider.tracked_variables["arrivals_s"] = ""

    def handle_timer(self, timer: str) -> None: ...

    def handle_packet(self, message: str) -> None:
        if message.startswith("setpoint"):
            self.provider.tracked_variables["arrivals_s"] += f"{self.provider.current_time():.9f} "
