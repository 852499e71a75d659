"""Nine nodes in prototype mode, with 10 ms of delay and 20 % losses, where consensus is difficult."""

import pytest

from gradysim.protocol.plugin.raft import RaftConfig, RaftConsensusPlugin, RaftMode
from gradysim.simulator.handler.communication import CommunicationHandler, CommunicationMedium
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from python.quiet_protocol import Quiet

NODES = 9
SEEDS = range(25)


class Member(Quiet):
    """Proposes 42 if it leads at 1.5 s, and logs the terms in which it has led."""

    mode = RaftMode.CLASSIC

    def initialize(self):
        config = RaftConfig().add_consensus_variable("value", int).set_raft_mode(self.mode).set_logging(False)
        self.consensus = RaftConsensusPlugin(config, self)
        self.consensus.set_known_nodes(range(NODES))
        self.consensus.start()
        self.led_terms = set()
        self.seen = []
        self.provider.schedule_timer("look", 0.05)

    def handle_timer(self, timer):
        now = self.provider.current_time()
        if self.consensus.is_leader():
            self.led_terms.add(self.consensus.get_current_term())
            if now > 1.5:
                self.consensus.propose_value("value", 42)
        self.provider.schedule_timer("look", now + 0.05)

    def handle_packet(self, message):
        raise AssertionError("a message of the consensus reached the protocol")


class FaultTolerantMember(Member):
    mode = RaftMode.FAULT_TOLERANT


def members_after(protocol, seed, medium, duration_s=3.0):
    builder = SimulationBuilder(
        SimulationConfiguration(duration=duration_s, seed=seed, execution_logging=False)
    )
    builder.add_handler(CommunicationHandler(medium)).add_handler(TimerHandler())
    for number in range(NODES):
        builder.add_node(protocol, (number, 0, 0))
    simulation = builder.build()
    simulation.start_simulation()
    return [simulation.get_node(number).protocol_encapsulator.protocol for number in range(NODES)]


@pytest.mark.parametrize("protocol", [Member, FaultTolerantMember])
@pytest.mark.parametrize("seed", SEEDS)
def test_terms_have_one_leader_and_a_value_arrives_everywhere(protocol, seed):
    members = members_after(protocol, seed, CommunicationMedium(delay=0.01, failure_rate=0.2))
    led_terms = [term for member in members for term in member.led_terms]
    assert len(led_terms) == len(set(led_terms)) >= 1
    assert [member.consensus.get_committed_value("value") for member in members] == [42] * NODES


def test_the_same_seed_gives_the_same_run():
    runs = [
        [
            member.consensus.get_state_info()
            for member in members_after(Member, 1, CommunicationMedium(delay=0.01, failure_rate=0.2), 1.0)
        ]
        for _ in range(2)
    ]
    assert runs[0] == runs[1]
