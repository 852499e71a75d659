"""The text of a protocol that does nothing, for the files of protocols that tests write."""

QUIET = """
from gradysim.protocol.interface import IProtocol

class Quiet(IProtocol):
    def initialize(self): pass
    def handle_timer(self, timer): pass
    def handle_packet(self, message): pass
    def handle_telemetry(self, telemetry): pass
    def finish(self): pass
"""
