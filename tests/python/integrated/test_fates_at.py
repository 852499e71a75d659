from collections import Counter

import pytest

from gradysim.integrated.fates_at import checked_fates_at
from gradysim.integrated.run import IntegratedRun, run

AT_ONCE = """
class Tested(Quiet):
    def initialize(self):
        if self.provider.get_id() != 1:
            self.provider.schedule_timer("talk", 1)
    def handle_timer(self, timer):
        self.provider.send_communication_command(BroadcastMessageCommand("hello"))
"""
"""All but node 1 send at the same instant: there, the frames of the others are lost to each other."""

ANSWERED = """
class Tested(Talker):
    def handle_timer(self, timer):
        next_node = (self.provider.get_id() + 1) % 3
        self.provider.send_communication_command(SendMessageCommand("hello", next_node))
        super().handle_timer(timer)
"""

THREE = "*.uavs.count = 3"


def test_a_run_tells_nothing_of_single_nodes_unasked(make_scenario):
    (node, *_) = run(make_scenario()).nodes
    assert (node.frame_fates, node.interferers) == (None, None)


def test_it_tells_of_those_it_is_asked_for(make_scenario):
    nodes = run(make_scenario("class Tested(Talker): pass", THREE), fates_at=[0, 2]).nodes
    assert [node.frame_fates is not None for node in nodes] == [True, False, True]


def test_what_interferes_is_named_and_what_never_happened_left_out(make_scenario):
    nodes = run(make_scenario(AT_ONCE, THREE), fates_at=range(3)).nodes
    assert nodes[1].frame_fates == {"broadcast": {"interference": 1, "receiver_locked": 1}}
    assert sum(nodes[1].interferers.values()) == 1
    assert nodes[1].interferers.keys() <= {"uavs[0]", "uavs[2]"}
    assert nodes[0].frame_fates == {"broadcast": {"receiver_transmitting": 1}}
    assert nodes[0].interferers == {}


def test_sums_over_all_nodes_are_those_of_the_network(make_scenario):
    scenario = make_scenario(ANSWERED, THREE)
    result = run(scenario, fates_at=range(3))
    of_network, of_nodes = Counter(), Counter()
    for kind, counts in result.fates["frames"].items():
        for fate in counts.keys() - {"below_sensitivity", "in_air"}:
            of_network[kind.removesuffix(" overheard"), fate] += counts[fate]
    for node in result.nodes:
        for kind, counts in node.frame_fates.items():
            for fate, copies in counts.items():
                of_nodes[kind, fate] += copies
    assert +of_network == of_nodes
    assert {"unicast", "ack", "broadcast"} <= {kind for kind, _ in of_nodes}


def test_to_be_asked_does_not_change_the_run(make_scenario):
    asked = run(make_scenario(), fates_at=[0])
    assert asked.fingerprint == run(make_scenario()).fingerprint


def test_a_run_that_was_stopped_tells_what_has_been(make_scenario):
    stopped = IntegratedRun(make_scenario(), fates_at=[0])
    stopped.execute(should_stop=lambda: True)
    assert stopped.result().nodes[0].frame_fates is not None


@pytest.mark.parametrize("node_id", [-1, 2])
def test_an_id_that_is_not_there_is_refused_before_the_run(make_scenario, node_id):
    with pytest.raises(
        ValueError, match=f"^fates_at: there is no node {node_id}; expected ids of the 2 nodes"
    ):
        IntegratedRun(make_scenario(), fates_at=[node_id])


@pytest.mark.parametrize("fates_at", [True, "all", [0.5], [None]])
def test_what_is_no_id_is_refused(fates_at):
    with pytest.raises(
        TypeError, match=r"^fates_at = .*: expected ids of nodes, such as \[0\], or range\(2\)"
    ):
        checked_fates_at(fates_at, 2)
