"""The protocol of the corpus."""

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.telemetry import Telemetry


class Quiet(IProtocol):
    """Does nothing."""

    interval: float = 1.0
    label: str = ""

    def initialize(self) -> None: ...
    def handle_timer(self, timer: str) -> None: ...
    def handle_packet(self, message: str) -> None: ...
    def handle_telemetry(self, telemetry: Telemetry) -> None: ...
    def finish(self) -> None: ...
