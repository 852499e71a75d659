"""The consensus itself: one node as a state machine, driven by messages and timers.

It follows "In Search of an Understandable Consensus Algorithm" (Ongaro, Ousterhout 2014), "Raft" below, and
the chapters on elections of Ongaro's dissertation (2014). What differs, and why it is as safe:

- A term belongs to one node (`term`), so no term has two leaders, whatever anybody counts as a majority.
- Every heartbeat carries the whole log (`raft_log`): the committed values and the few entries after them. It
  is both AppendEntries and InstallSnapshot of the papers, and one that arrives makes up for all that were
  lost.
- Before an election a node asks who is there and would vote for it, which is both the PreVote of the
  dissertation and the discovery of active nodes; nodes that hear a leader refuse, and a leader without a
  majority resigns.
"""

import logging
from collections.abc import Iterable
from typing import Any

from gradysim.protocol.plugin.raft.candidacy import Candidacy
from gradysim.protocol.plugin.raft.environment import Environment
from gradysim.protocol.plugin.raft.following import Following
from gradysim.protocol.plugin.raft.node_timers import (
    DISCOVERY_TIMER,
    ELECTION_TIMER,
    HEARTBEAT_TIMER,
    REPLY_TIMER,
)
from gradysim.protocol.plugin.raft.office import Office
from gradysim.protocol.plugin.raft.persistent_state import PersistentState
from gradysim.protocol.plugin.raft.raft_config import RaftConfig
from gradysim.protocol.plugin.raft.raft_core import RaftCore
from gradysim.protocol.plugin.raft.raft_message import (
    AppendEntries,
    AppendEntriesResponse,
    DiscoveryHeartbeat,
    DiscoveryHeartbeatResponse,
    RequestVote,
    RequestVoteResponse,
    parse_message,
)
from gradysim.protocol.plugin.raft.raft_state import RaftState
from gradysim.protocol.plugin.raft.voting import Voting


class RaftNode(RaftCore):
    """One member of the cluster: what its owner may do with it, and which part of it gets what."""

    def __init__(
        self, config: RaftConfig, environment: Environment, persistent: PersistentState | None = None
    ) -> None:
        """Make a node that begins anew, or goes on from what it knew before a crash."""
        super().__init__(config, environment, persistent)
        self._following = Following(self)
        self._voting = Voting(self)
        self._office = Office(self)
        self._candidacy = Candidacy(self, self._office)

    def start(self) -> None:
        """Begin to take part, as a follower; while it does already, only its election timeout begins anew."""
        self.is_running = True
        if self.is_active and self.state is not RaftState.LEADER:
            self.timers.restart_election()

    def stop(self) -> None:
        """Fall silent and deaf. What is known stays, and `start` goes on from there."""
        self.is_running = False
        self._fall_silent()

    def set_active(self, active: bool) -> None:
        """Play dead, or rise again as a follower. A leader that plays dead gives up its term."""
        if active == self.is_active:
            return
        if not active and self.state is RaftState.LEADER:
            self.adopt_term(self.persistent.current_term + 1)
        self.is_active = active
        if active:
            if self.is_running:
                self.timers.restart_election()
        else:
            self._fall_silent()

    def set_known_nodes(self, node_ids: Iterable[int]) -> None:
        """Set the members once and for all: nobody else is heard or counted."""
        self.membership.fix(node_ids)
        self.activity.watch_members()
        self._office.commit_what_can_be()

    def propose(self, name: str, value: Any) -> bool:
        """Add an entry to the log; False unless this node leads. A value that holds already needs none."""
        return self._office.propose(name, value)

    def send_text(self, text: str) -> None:
        """Broadcast something that is no message of the consensus."""
        if self.is_active:
            self.environment.send(text, None)

    def handle_timer(self, name: str) -> None:
        """One of the node's timers is due."""
        self.timers.pending.discard(name)
        if not (self.is_running and self.is_active):
            return
        if name == ELECTION_TIMER:
            self._candidacy.handle_election_timeout()
        elif name == DISCOVERY_TIMER:
            self._candidacy.handle_discovery_timeout()
        elif name == HEARTBEAT_TIMER and self.election is not None:
            self._candidacy.request_votes()
        elif name == HEARTBEAT_TIMER:
            self._office.handle_heartbeat()
        elif name == REPLY_TIMER:
            self.outbox.send_reply()

    def handle_message(self, text: str) -> None:
        """A message has arrived. What is not one is ignored."""
        if not (self.is_running and self.is_active):
            return
        try:
            message = parse_message(text)
        except ValueError as error:
            self.log(logging.WARNING, "ignoring a message: %s", error)
            return
        sender = message.sender_id
        if sender == self.node_id or not self.membership.accepts(sender) or not self.cluster.accepts(message):
            return
        knew = self.membership.known
        self.membership.learn([sender, *(message.known_nodes or ())])
        if self.membership.known != knew:
            self.activity.watch_members()
        match message:
            case AppendEntries():
                self._following.handle_entries(message)
            case AppendEntriesResponse():
                self._office.handle_entries_response(message)
            case DiscoveryHeartbeat():
                self._voting.handle_discovery(message, knew)
            case DiscoveryHeartbeatResponse():
                self._candidacy.handle_discovery_response(message)
            case RequestVote():
                self._voting.handle_vote_request(message, knew)
            case RequestVoteResponse():
                self._candidacy.handle_vote(message)

    def _fall_silent(self) -> None:
        self.become_follower()
        self.leader_id = None
        self.leader_heard_s = None
        self.activity.shared = None
        self.timers.cancel(ELECTION_TIMER)
        self.outbox.clear()
