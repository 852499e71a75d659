"""Delays of messages in both modes: from the send command to the callback of the receiver."""

import pytest

import gradysim.integrated.run
import gradysim.prototype.run

MODES = {"integrated": gradysim.integrated.run.run, "prototype": gradysim.prototype.run.run}

TIMED = """
class Tested(Quiet):
    sends = "broadcast"
    def initialize(self):
        self.provider.tracked_variables["delays"] = []
        self.provider.schedule_timer("send", 0.1 + 0.001 * self.provider.get_id())
    def handle_timer(self, timer):
        now = repr(self.provider.current_time())
        other = 1 - self.provider.get_id()
        broadcast, unicast = BroadcastMessageCommand(now), SendMessageCommand(now, other)
        self.provider.send_communication_command(broadcast if self.sends == "broadcast" else unicast)
        self.provider.schedule_timer("send", self.provider.current_time() + 0.1)
    def handle_packet(self, message):
        delay_s = self.provider.current_time() - float(message)
        self.provider.tracked_variables["delays"].append(delay_s)
"""


@pytest.fixture(params=MODES)
def run(request):
    return MODES[request.param]


@pytest.mark.parametrize("kind", ["broadcast", "unicast"])
def test_they_are_what_protocols_measure(run, make_scenario, kind):
    settings = f'**.sends = "{kind}"', "*.communicationMedium.delay = 3ms"
    result = run(make_scenario(TIMED, *settings))
    measured = [delay_s for node in result.nodes for delay_s in node.tracked_variables["delays"]]
    assert list(result.message_delays) == [kind]
    delays = result.message_delays[kind]
    assert (delays.count, len(measured)) == (len(measured), 40)
    assert delays.mean_s == pytest.approx(sum(measured) / len(measured))
    assert (delays.min_s, delays.max_s) == pytest.approx((min(measured), max(measured)))
    assert min(measured) <= delays.quantile_s(0.5) <= max(measured)


def test_who_hears_nothing_has_no_delays(run, make_scenario):
    assert run(make_scenario("class Tested(Quiet): pass")).message_delays == {}
