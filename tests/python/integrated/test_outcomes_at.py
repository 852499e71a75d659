from collections import Counter

import pytest

from gradysim.integrated.run import IntegratedRun, run

AT_ONCE = """
class Tested(Quiet):
    def initialize(self):
        if self.provider.get_id() != 1:
            self.provider.schedule_timer("talk", 1)
    def handle_timer(self, timer):
        self.provider.send_communication_command(BroadcastMessageCommand("hello"))
"""
"""All nodes except node 1 send at the same instant: their frames are lost to each other."""

ANSWERED = """
class Tested(Talker):
    def handle_timer(self, timer):
        next_node = (self.provider.get_id() + 1) % 3
        self.provider.send_communication_command(SendMessageCommand("hello", next_node))
        super().handle_timer(timer)
"""

BY_TWO_RADIOS = """
class Tested(Quiet):
    def initialize(self):
        self.provider.schedule_timer("talk", 1)
    def handle_timer(self, timer):
        node_id = self.provider.get_id()
        if node_id == 0:
            for interface in (0, 1, 1):
                self.provider.send_communication_command(SendMessageCommand("hello", 1, interface=interface))
        if node_id == 2:
            self.provider.send_communication_command(BroadcastMessageCommand("hello"))
"""
"""Node 1 is on the channel of node 0's first radio, not of its second one."""

TWO_RADIOS = ("*.uavs[0].numWlanInterfaces = 2", "*.uavs[0].wlan[1].radio.channelNumber = 5")

THREE = "*.uavs.count = 3"


def test_a_run_tells_nothing_of_single_nodes_unasked(make_scenario):
    (node, *_) = run(make_scenario()).nodes
    assert (node.frame_outcomes, node.interferers, node.message_outcomes) == (None, None, None)


def test_it_tells_of_those_it_is_asked_for(make_scenario):
    nodes = run(make_scenario("class Tested(Talker): pass", THREE), outcomes_at=[0, 2]).nodes
    assert [node.frame_outcomes is not None for node in nodes] == [True, False, True]


def test_what_interferes_is_named_and_what_never_happened_left_out(make_scenario):
    nodes = run(make_scenario(AT_ONCE, THREE), outcomes_at=range(3)).nodes
    assert nodes[1].frame_outcomes == {"broadcast": {"interference": 1, "receiver_locked": 1}}
    assert sum(nodes[1].interferers.values()) == 1
    assert nodes[1].interferers.keys() <= {"uavs[0]", "uavs[2]"}
    assert nodes[0].frame_outcomes == {"broadcast": {"receiver_transmitting": 1}}
    assert nodes[0].interferers == {}


def test_sums_over_all_nodes_are_those_of_the_network(make_scenario):
    scenario = make_scenario(ANSWERED, THREE)
    result = run(scenario, outcomes_at=range(3))
    of_network, of_nodes = Counter(), Counter()
    for kind, counts in result.outcomes["frames"].items():
        for outcome in counts.keys() - {"below_sensitivity", "in_air"}:
            of_network[kind.removesuffix(" overheard"), outcome] += counts[outcome]
    for node in result.nodes:
        for kind, counts in node.frame_outcomes.items():
            for outcome, copies in counts.items():
                of_nodes[kind, outcome] += copies
    assert +of_network == of_nodes
    assert {"unicast", "ack", "broadcast"} <= {kind for kind, _ in of_nodes}


def test_messages_of_each_interface_are_told_apart(make_scenario):
    nodes = run(make_scenario(BY_TWO_RADIOS, THREE, *TWO_RADIOS), outcomes_at=range(3)).nodes
    assert [node.message_outcomes for node in nodes] == [
        {"wlan[0]": {"unicast": {"acknowledged": 1}}, "wlan[1]": {"unicast": {"retry_limit": 2}}},
        {"wlan[0]": {}},
        {"wlan[0]": {"broadcast": {"sent": 1}}},
    ]


@pytest.mark.parametrize(("python", "settings"), [(ANSWERED, ()), (BY_TWO_RADIOS, TWO_RADIOS)])
def test_sums_of_messages_over_all_interfaces_are_those_of_the_network(make_scenario, python, settings):
    result = run(make_scenario(python, THREE, *settings), outcomes_at=range(3))
    of_network, of_interfaces = Counter(), Counter()
    for kind, counts in result.outcomes["messages"].items():
        of_network.update({(kind, outcome): count for outcome, count in counts.items()})
    for node in result.nodes:
        for kinds in node.message_outcomes.values():
            for kind, counts in kinds.items():
                of_interfaces.update({(kind, outcome): count for outcome, count in counts.items()})
    assert +of_network == of_interfaces
    assert len(of_interfaces) >= 2


def test_to_be_asked_does_not_change_the_run(make_scenario):
    asked = run(make_scenario(), outcomes_at=[0])
    assert asked.result_hash == run(make_scenario()).result_hash


def test_a_run_that_was_stopped_tells_what_has_been(make_scenario):
    stopped = IntegratedRun(make_scenario(), outcomes_at=[0])
    stopped.execute(should_stop=lambda: True)
    assert stopped.result().nodes[0].frame_outcomes is not None


@pytest.mark.parametrize("node_id", [-1, 2])
def test_an_id_that_is_not_there_is_refused_before_the_run(make_scenario, node_id):
    with pytest.raises(ValueError, match=r"^outcomes_at: "):
        IntegratedRun(make_scenario(), outcomes_at=[node_id])
