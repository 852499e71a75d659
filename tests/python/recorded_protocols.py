"""Protocols with known vectors, and their records, for both modes."""

COUNTER = """
class Tested(Quiet):
    def initialize(self):
        self.provider.tracked_variables["count"] = 0
        self.provider.schedule_timer("tick", 0.07)
    def handle_timer(self, timer):
        self.provider.tracked_variables["count"] += 1
        self.provider.schedule_timer("tick", self.provider.current_time() + 0.7)
    def finish(self):
        self.provider.tracked_variables = {"finished": True}
"""

FLYING = """
class Tested(Quiet):
    def initialize(self):
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(0, 0, 100))
"""

EARLY = """
class Tested(Quiet):
    @classmethod
    def instantiate(cls, provider):
        protocol = super().instantiate(provider)
        protocol.tracked = provider.tracked_variables
        protocol.tracked["made"] = 1
        return protocol
    def initialize(self):
        self.tracked["begun"] = 2
    def handle_telemetry(self, telemetry):
        self.tracked["begun"] += 1
"""


def vectors_of(result, node=0):
    return {vector.name: vector for vector in result.nodes[node].vectors}
