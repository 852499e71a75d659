"""Slots without a common clock: the base takes whatever comes in a slot for the report of its owner."""

from node import Node

_SLOT_S = 0.5


class Drone(Node):
    """Sends in the middle of its slot, by its own clock. Slots follow the ids, from 1 on."""

    def initialize(self) -> None:
        self.provider.schedule_timer("send", (self.provider.get_id() + 0.5) * _SLOT_S)

    def handle_timer(self, timer: str) -> None:
        self.broadcast(f"report of {self.provider.get_id()}")
        self.set_timer_in("send", 3 * _SLOT_S)


class Base(Node):
    """Counts reports in their slots and outside of them."""

    def initialize(self) -> None:
        self.owner = 0
        self.set_timer_in("slot", _SLOT_S)

    def handle_timer(self, timer: str) -> None:
        self.owner = self.owner % 3 + 1
        self.set_timer_in("slot", _SLOT_S)

    def handle_packet(self, message: str) -> None:
        is_owner = int(message.removeprefix("report of ")) == self.owner
        self.count("expected" if is_owner else "mixed up")
