"""Timeout below the airtime: a camera repeats a photo after 8 ms, and the frame alone takes 11.7 ms."""

from node import Node


class Camera(Node):
    """Sends a photo to the base, node 0, each 25 ms, and repeats it until the base has confirmed it."""

    def initialize(self) -> None:
        self.number = 0
        self.set_timer_in("next", 1)

    def handle_timer(self, timer: str) -> None:
        if timer == "next":
            self.number += 1
            self.provider.cancel_timer("timeout")
            self.set_timer_in("next", 0.025)
        self.send(f"photo {self.number}".ljust(1400), 0)
        self.set_timer_in("timeout", 0.008)

    def handle_packet(self, message: str) -> None:
        if message == f"got {self.number}":
            self.provider.cancel_timer("timeout")


class Base(Node):
    """Confirms each photo to the camera, node 1, and counts the different ones."""

    def initialize(self) -> None:
        self.seen: set[str] = set()

    def handle_packet(self, message: str) -> None:
        number = message.split()[1]
        if number not in self.seen:
            self.seen.add(number)
            self.count("photos")
        self.send(f"got {number}", 1)
