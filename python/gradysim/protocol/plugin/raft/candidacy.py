"""On the way to lead: a node looks round, and stands for election if that promises success."""

import logging

from gradysim.protocol.plugin.raft.election import Discovery, Election
from gradysim.protocol.plugin.raft.node_timers import DISCOVERY_ROUNDS, DISCOVERY_TIMER
from gradysim.protocol.plugin.raft.office import Office
from gradysim.protocol.plugin.raft.raft_core import RaftCore
from gradysim.protocol.plugin.raft.raft_message import (
    DiscoveryHeartbeat,
    DiscoveryHeartbeatResponse,
    RequestVote,
    RequestVoteResponse,
)
from gradysim.protocol.plugin.raft.raft_state import RaftState
from gradysim.protocol.plugin.raft.term import next_own_term


class Candidacy:
    """From a leader that falls silent to the majority of the votes."""

    def __init__(self, core: RaftCore, office: Office) -> None:
        """Take part in the node's state; `office` begins when the election is won."""
        self._core = core
        self._office = office

    def handle_election_timeout(self) -> None:
        """No leader was heard for too long: look round."""
        core = self._core
        if core.state is RaftState.LEADER:
            return
        core.become_follower()
        core.leader_id = None
        core.leader_heard_s = None
        core.discovery = Discovery(DISCOVERY_ROUNDS)
        core.log(logging.DEBUG, "no leader heard, looking round")
        if core.membership.is_alone_by_choice:
            self._conclude_discovery()
        else:
            self.handle_discovery_timeout()

    def handle_discovery_timeout(self) -> None:
        """A round of asking who is there is over: begin the next one, or draw the conclusion."""
        core = self._core
        discovery = core.discovery
        if discovery is None:
            return
        if discovery.rounds_left == 0:
            self._conclude_discovery()
            return
        discovery.rounds_left -= 1
        log = core.persistent.log
        core.outbox.broadcast(
            DiscoveryHeartbeat(
                core.persistent.current_term,
                core.node_id,
                log.last_index,
                log.last_term,
                answered=sorted(discovery.answered),
            )
        )
        core.timers.restart_discovery_round()

    def handle_discovery_response(self, message: DiscoveryHeartbeatResponse) -> None:
        """Somebody is there."""
        core = self._core
        core.adopt_term(message.term)
        discovery = core.discovery
        if discovery is None:
            return
        discovery.answered.add(message.responder_id)
        if message.would_vote:
            discovery.willing.add(message.responder_id)
        if not core.membership.is_fixed:
            return  # somebody unknown may answer yet
        known = core.membership.known
        if discovery.answered >= core.membership.others or (
            core.config.is_classic_mode() and core.has_majority({*discovery.willing, core.node_id}, known)
        ):
            self._conclude_discovery()

    def _conclude_discovery(self) -> None:
        core = self._core
        discovery = core.discovery
        assert discovery is not None
        core.discovery = None
        core.timers.cancel(DISCOVERY_TIMER)
        core.timers.restart_election()
        seen = {*discovery.answered, core.node_id}
        electorate = core.membership.known if core.config.is_classic_mode() else frozenset(seen)
        if not core.has_majority({*discovery.willing, core.node_id}, electorate):
            return
        persistent = core.persistent
        persistent.current_term = next_own_term(persistent.current_term, core.node_id)
        persistent.voted_for = core.node_id
        core.leader_id = None
        core.state = RaftState.CANDIDATE
        core.election = Election(seen, {core.node_id})
        core.log(logging.INFO, "candidate in term %s, seeing %s nodes", persistent.current_term, len(seen))
        if not self._count_votes():
            self.request_votes()

    def request_votes(self) -> None:
        """Ask everybody, once more with each heartbeat until the election is decided."""
        core = self._core
        log = core.persistent.log
        core.outbox.broadcast(
            RequestVote(core.persistent.current_term, core.node_id, log.last_index, log.last_term)
        )
        core.timers.restart_heartbeat()

    def handle_vote(self, message: RequestVoteResponse) -> None:
        """Somebody has voted."""
        core = self._core
        core.adopt_term(message.term)
        if (
            core.election is not None
            and message.vote_granted
            and message.term == core.persistent.current_term
        ):
            core.election.seen.add(message.voter_id)
            core.election.votes.add(message.voter_id)
            self._count_votes()

    def _count_votes(self) -> bool:
        """Begin to lead if the votes are enough; whether they are."""
        core = self._core
        election = core.election
        assert election is not None
        if not core.has_majority(election.votes, core.electorate()):
            return False
        self._office.begin(election)
        return True
