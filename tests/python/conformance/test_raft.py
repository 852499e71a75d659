"""Raft nodes elect, agree, fail and recover alike in both modes."""

import re
from typing import ClassVar

import pytest
from perfect_channel import Case
from watched_run import Trace, assert_same, trace_case

from gradysim.protocol.plugin.raft import RaftConfig, RaftConsensusPlugin, RaftMode
from python.quiet_protocol import Quiet

NODES = 5
CASE = Case([(10.0 * node, 0.0, 0.0) for node in range(NODES)], range_m=100.0, seed=1, duration_s=6.0)


class Member(Quiet):
    """Proposes as leader. The leader of the third second fails, and recovers two seconds later."""

    mode: ClassVar[RaftMode]
    told: ClassVar[bool]

    def initialize(self) -> None:
        config = RaftConfig().add_consensus_variable("value", int).set_raft_mode(self.mode).set_logging(False)
        config.get_failure_config().set_failure_threshold(2)
        self.consensus = RaftConsensusPlugin(config, self)
        if self.told:
            self.consensus.set_known_nodes(range(NODES))
        self.consensus.start()
        for name in ("leaders", "values", "failed", "active"):
            self.provider.tracked_variables[name] = []
        self.provider.schedule_timer("fail", 3.001)
        self.provider.schedule_timer("look", 0.0503)

    def handle_timer(self, timer: str) -> None:
        me = self.provider.get_id()
        if timer == "fail" and self.consensus.is_leader():
            self.consensus.set_simulation_active(me, False)
            self.provider.schedule_timer("recover", 5.001)
        elif timer == "recover":
            self.consensus.set_simulation_active(me, True)
        elif timer == "look":
            self.look()
            self.provider.schedule_timer("look", self.provider.current_time() + 0.0503)

    def look(self) -> None:
        consensus = self.consensus
        if consensus.is_leader():
            consensus.propose_value("value", round(self.provider.current_time()))
        self.note("leaders", (consensus.get_current_term(), consensus.get_leader_id()))
        self.note("values", consensus.get_committed_value("value"))
        self.note("failed", sorted(consensus.get_failed_nodes()))
        self.note("active", sorted(consensus.get_active_nodes()))

    def note(self, name: str, value: object) -> None:
        values = self.provider.tracked_variables[name]
        if not values or values[-1] != value:
            values.append(value)

    def finish(self) -> None:
        tracked = self.provider.tracked_variables
        tracked["state"] = self.consensus.get_state_info()
        tracked["detection"] = self.consensus.get_failure_detection_metrics()
        tracked["nodes"] = self.consensus.get_active_nodes_info()


def agree(mode: RaftMode, *, told: bool) -> Trace:
    """Check that both modes of the simulator agree; return the trace."""
    member = type("Member", (Member,), {"mode": mode, "told": told})
    integrated, prototype = (trace_case(name, CASE, member) for name in ("integrated", "prototype"))
    assert_same(integrated, prototype)
    return integrated


@pytest.mark.parametrize("told", [True, False], ids=["members told", "members found"])
@pytest.mark.parametrize("mode", RaftMode)
def test_the_same_elections_agreements_and_failures(mode: RaftMode, told: bool) -> None:
    trace = agree(mode, told=told)
    for tracked in trace.tracked:
        assert re.search(r"'values': \[None, 0, 1, .*6\], 'failed'", tracked)
        assert len(set(re.findall(r"\(\d+, (\d)\)", tracked))) > 1, "the leader should change"
    if mode is RaftMode.FAULT_TOLERANT:
        assert any(re.search(r"'failed': \[\[\], \[\d\], \[\]\]", tracked) for tracked in trace.tracked)
