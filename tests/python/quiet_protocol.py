"""A protocol that does nothing, as a base class, and as source code for files."""

import inspect

from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.telemetry import Telemetry


class Quiet(IProtocol):
    """Does nothing in its callbacks."""

    def initialize(self) -> None: ...
    def handle_timer(self, timer: str) -> None: ...
    def handle_packet(self, message: str) -> None: ...
    def handle_telemetry(self, telemetry: Telemetry) -> None: ...
    def finish(self) -> None: ...


QUIET = f"""
from gradysim.protocol.interface import IProtocol
from gradysim.protocol.messages.telemetry import Telemetry

{inspect.getsource(Quiet)}"""
