"""A protocol that records its callbacks."""

from gradysim.protocol.interface import IProtocol


class RecordingProtocol(IProtocol):
    """Records its callbacks, as (name, *arguments); subclasses may override `note`."""

    def __init__(self):
        self.calls = []

    def note(self, *call):
        self.calls.append(call)

    def initialize(self):
        self.note("initialize")

    def handle_timer(self, timer):
        self.note("handle_timer", timer)

    def handle_packet(self, message):
        self.note("handle_packet", message)

    def handle_telemetry(self, telemetry):
        self.note("handle_telemetry", telemetry)

    def finish(self):
        self.note("finish")
