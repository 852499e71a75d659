"""A protocol that keeps what it was called with."""

from gradysim.protocol.interface import IProtocol


class RecordingProtocol(IProtocol):
    """Keeps the callbacks that reach it, as (name, *arguments)."""

    def __init__(self):
        self.calls = []

    def initialize(self):
        self.calls.append(("initialize",))

    def handle_timer(self, timer):
        self.calls.append(("handle_timer", timer))

    def handle_packet(self, message):
        self.calls.append(("handle_packet", message))

    def handle_telemetry(self, telemetry):
        self.calls.append(("handle_telemetry", telemetry))

    def finish(self):
        self.calls.append(("finish",))
