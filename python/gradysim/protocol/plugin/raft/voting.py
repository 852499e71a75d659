"""A voter: it judges who may lead."""

from gradysim.protocol.plugin.raft.raft_core import RaftCore
from gradysim.protocol.plugin.raft.raft_message import (
    DiscoveryHeartbeat,
    DiscoveryHeartbeatResponse,
    RequestVote,
    RequestVoteResponse,
)


class Voting:
    """Answers those that ask for votes, or who is there."""

    def __init__(self, core: RaftCore) -> None:
        """Take part in the node's state."""
        self._core = core

    def handle_discovery(self, message: DiscoveryHeartbeat, knew: frozenset[int]) -> None:
        """Somebody asks who is there; `knew` are the members that this node knew before."""
        core = self._core
        if core.node_id in message.answered:
            return
        would_vote = self._would_vote(message, knew)
        if would_vote and core.discovery is None:
            core.timers.restart_election()  # the asking node goes first
        core.outbox.reply(
            DiscoveryHeartbeatResponse(core.persistent.current_term, core.node_id, would_vote),
            message.sender_id,
        )

    def handle_vote_request(self, message: RequestVote, knew: frozenset[int]) -> None:
        """Somebody wants this node's vote; `knew` are the members that this node knew before."""
        core = self._core
        persistent = core.persistent
        granted = False
        if message.term >= persistent.current_term and not core.hears_leader():
            core.adopt_term(message.term)
            granted = persistent.voted_for in (None, message.candidate_id) and self._would_vote(message, knew)
            if granted:
                persistent.voted_for = message.candidate_id
                core.stop_discovery()
                core.timers.restart_election()
        core.outbox.reply(
            RequestVoteResponse(persistent.current_term, granted, core.node_id), message.candidate_id
        )

    def _would_vote(self, message: RequestVote | DiscoveryHeartbeat, knew: frozenset[int]) -> bool:
        """Whether a node deserves a vote: no leader is there, its log is as good, its members are as many."""
        core = self._core
        if core.hears_leader():
            return False
        if not core.membership.is_fixed and not knew <= {
            message.sender_id,
            *(message.known_nodes or knew),
        }:
            return False
        return core.persistent.log.is_up_to_date(message.last_log_index, message.last_log_term)
