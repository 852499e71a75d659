from collections.abc import Callable

import pytest

from gradysim.scenario.scenario import Scenario

PROTOCOL = """
class Tested(Quiet):
    messages: int = 1
    def initialize(self):
        if self.provider.get_id() != 1:
            self.provider.schedule_timer("talk", 1)
    def handle_timer(self, timer):
        for _ in range(self.messages):
            self.provider.send_communication_command(BroadcastMessageCommand("x" * 500))
"""


@pytest.fixture
def make_hidden_senders(make_scenario: Callable[..., Scenario]) -> Callable[..., Scenario]:
    """`make_hidden_senders(*settings)`: two nodes that send to a third one, and do not notice each other."""
    places = ("*.uavs.count = 3", "*.uavs[*].mobility.lineStepX = 400m")
    return lambda *settings: make_scenario(PROTOCOL, *places, *settings)
