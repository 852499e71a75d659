"""Hours into a run, float seconds are more than a picosecond apart; the current time is still valid."""

from gradysim.integrated.run import run
from python.integrated.watching import Stepping

TALKING_FOR_HOURS = """
class Tested(Quiet):
    def initialize(self):
        self.heard = self.done = 0
        self.provider.schedule_timer("talk", 8192.0 + self.provider.get_id())

    def handle_timer(self, timer):
        if timer == "talk":
            self.provider.send_communication_command(BroadcastMessageCommand("hello"))
            self.provider.schedule_timer("talk", self.provider.current_time() + 37.123)
        else:
            self.done += 1

    def handle_packet(self, message):
        self.heard += 1
        self.provider.schedule_timer("now", self.provider.current_time())

    def finish(self):
        self.provider.tracked_variables.update(heard=self.heard, done=self.done)
"""
FIVE_HOURS = ["sim-time-limit = 5h", "*.uavs[*].mobility.telemetryInterval = 0s"]


def test_a_timer_for_now_is_not_in_the_past(make_scenario):
    nodes = run(make_scenario(TALKING_FOR_HOURS, *FIVE_HOURS)).nodes
    for node in nodes:
        assert node.tracked_variables["heard"] > 200
        assert node.tracked_variables["done"] == node.tracked_variables["heard"]


def test_what_a_handler_schedules_for_now_is_not_in_the_past(make_scenario):
    class AtOnce(Stepping):
        scheduled = done = 0

        def after_simulation_step(self, iteration, timestamp):
            if iteration % 7 == 0:
                self.scheduled += 1
                self.event_loop.schedule_event(self.event_loop.current_time, self.count)

        def count(self):
            self.done += 1

    handler = AtOnce()
    run(make_scenario(TALKING_FOR_HOURS, *FIVE_HOURS), handlers=[handler])
    assert handler.done == handler.scheduled > 200
