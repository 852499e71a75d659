"""Telephone calls over one cell: every 10 ms a packet of speech in each direction."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.communication import SendMessageCommand

INTERVAL_S = 0.01
PACKET_B = 92
"""80 B of speech at 64 kbps, and 12 B of RTP."""
LATEST_S = 0.05
FROM_S, UNTIL_S = 2.0, 11.5
"""Packets that are sent in this time count."""


class _Speaker(IProtocol):
    """Counts what it sends, and what arrives within 50 ms."""

    partners: tuple[int, ...] = ()

    def initialize(self) -> None:
        self.provider.tracked_variables.update(sent=0, in_time=0)
        for partner in self.partners:
            self.provider.schedule_timer(str(partner), self.provider.random.uniform(0, INTERVAL_S))

    def handle_timer(self, timer: str) -> None:
        now_s = self.provider.current_time()
        text = f"{now_s:.9f}".ljust(PACKET_B)
        self.provider.send_communication_command(SendMessageCommand(text, int(timer)))
        self.provider.tracked_variables["sent"] += FROM_S <= now_s < UNTIL_S
        self.provider.schedule_timer(timer, now_s + INTERVAL_S)

    def handle_packet(self, message: str) -> None:
        sent_s = float(message)
        if FROM_S <= sent_s < UNTIL_S:
            self.provider.tracked_variables["in_time"] += self.provider.current_time() - sent_s <= LATEST_S


class Phone(_Speaker):
    """Calls the base."""

    def initialize(self) -> None:
        self.partners = (self.provider.id_of("base[0]"),)
        super().initialize()


class Base(_Speaker):
    """Answers all phones, which have the lower ids."""

    def initialize(self) -> None:
        self.partners = tuple(range(self.provider.get_id()))
        super().initialize()
