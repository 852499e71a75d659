"""The Raft state machine: one node, driven by messages and timers.

It follows "In Search of an Understandable Consensus Algorithm" (Ongaro, Ousterhout 2014), cited as "Raft",
and the chapters on elections of Ongaro's dissertation (2014). The differences:

- A term belongs to one node (`next_own_term`), so no term has two leaders, even if majorities do not overlap.
- Every heartbeat carries the whole log: the committed values and the few entries after them. It is both
  AppendEntries and InstallSnapshot of the paper. One received heartbeat makes up for all lost ones.
- Before an election a node asks which nodes are there and would vote for it. This discovery is the PreVote
  of the dissertation. Nodes that hear a leader refuse, and a leader without a majority steps down.
"""

import logging
from collections.abc import Iterable
from typing import Any

from gradysim.protocol.interface import IProvider
from gradysim.protocol.plugin.raft.membership_view import LeaderView, MembershipView
from gradysim.protocol.plugin.raft.raft_config import RaftConfig
from gradysim.protocol.plugin.raft.raft_message import (
    AppendEntries,
    AppendEntriesResponse,
    DiscoveryHeartbeat,
    DiscoveryHeartbeatResponse,
    RaftMessage,
    RequestVote,
    RequestVoteResponse,
    parse_message,
)
from gradysim.protocol.plugin.raft.raft_state import (
    Discovery,
    Election,
    Entry,
    Leadership,
    PersistentState,
    RaftState,
    majority_of,
    next_own_term,
    same_value,
)
from gradysim.protocol.plugin.raft.transport import REPLY_TIMER, Transport

ELECTION_TIMER = "election_timeout"
HEARTBEAT_TIMER = "heartbeat"
DISCOVERY_TIMER = "discovery_timeout"

_DISCOVERY_ROUNDS = 6
# Range of the random factor of heartbeat and discovery timers, so that nodes do not stay synchronized.
_JITTER = (0.9, 1.1)
# All nodes answer a broadcast. To avoid collisions, a reply waits for a random time of up to this fraction
# of a heartbeat interval, and at most this time.
_REPLY_SPREAD = 0.1
_REPLY_SPREAD_MAX_S = 0.005

_logger = logging.getLogger(__name__)


class RaftNode:
    """One member of the cluster.

    Attributes:
        persistent: Term, vote and log, which survive a crash.
        membership: Which nodes are members, and which of them are active.
        transport: Messages and timers.
        leader_id: Leader of the current term, if the node knows one.
        leader_heard_s: Time (s) of the latest AppendEntries of that leader.
        is_running: Whether the node is between `start` and `stop`.
        is_active: Whether `set_active` lets the node send and receive.
        discovery: State of the discovery; None if none is in progress.
        election: State of the candidate; None for other roles.
        leadership: State of the leader; None for other roles.
    """

    def __init__(
        self, config: RaftConfig, provider: IProvider, persistent: PersistentState | None = None
    ) -> None:
        """Create a follower. `persistent`: its state before a crash."""
        self.config = config
        self.node_id = provider.get_id()
        self.persistent = persistent or PersistentState()
        self.membership = MembershipView(self.node_id, config.get_failure_config(), provider.current_time)
        self.transport = Transport(provider, self.membership)
        self.leader_id: int | None = None
        self.leader_heard_s: float | None = None
        self.is_running = False
        self.is_active = True
        self.discovery: Discovery | None = None
        self.election: Election | None = None
        self.leadership: Leadership | None = None

    @property
    def state(self) -> RaftState:
        """Role of the node."""
        if self.leadership is not None:
            return RaftState.LEADER
        return RaftState.FOLLOWER if self.election is None else RaftState.CANDIDATE

    # ---- starting, stopping and incoming events ------------------------------------------------------------

    def start(self) -> None:
        """Start as a follower. If the node is running already, only restart its election timeout."""
        self.is_running = True
        if self.is_active and self.state is not RaftState.LEADER:
            self._restart_election_timer()

    def stop(self) -> None:
        """Stop sending and receiving. Term, vote and log stay, and `start` continues from there."""
        self.is_running = False
        self._fall_silent()

    def set_active(self, active: bool) -> None:
        """Simulate a failure, or a recovery as a follower. A failing leader gives up its term first."""
        if active == self.is_active:
            return
        if not active and self.state is RaftState.LEADER:
            self.adopt_term(self.persistent.current_term + 1)
        self.is_active = active
        if not active:
            self._fall_silent()
        elif self.is_running:
            self._restart_election_timer()

    def set_known_nodes(self, node_ids: Iterable[int]) -> None:
        """Set the members. Other nodes are then ignored."""
        self.membership.fix(node_ids)
        self._commit_majority()

    def send_text(self, text: str) -> None:
        """Broadcast a string, which need not be a Raft message."""
        if self.is_active:
            self.transport.broadcast_text(text)

    def handle_timer(self, name: str) -> None:
        """Handle a timer of this node that has fired."""
        self.transport.pending_timers.discard(name)
        if not (self.is_running and self.is_active):
            return
        if name == ELECTION_TIMER:
            self._handle_election_timeout()
        elif name == DISCOVERY_TIMER:
            self._continue_discovery()
        elif name == HEARTBEAT_TIMER and self.election is not None:
            self._request_votes()
        elif name == HEARTBEAT_TIMER:
            self._handle_heartbeat_timer()
        elif name == REPLY_TIMER:
            self.transport.send_next_reply()

    def handle_message(self, text: str) -> None:
        """Handle a message. Ignore strings that are not messages."""
        if not (self.is_running and self.is_active):
            return
        try:
            message = parse_message(text)
        except ValueError as error:
            self.log(logging.WARNING, "ignoring a message: %s", error)
            return
        if not self.membership.accepts(message):
            return
        known_before = self.membership.known
        self.membership.learn([message.sender_id, *(message.known_nodes or ())])
        match message:
            case AppendEntries():
                self._handle_append_entries(message)
            case AppendEntriesResponse():
                self._handle_append_entries_response(message)
            case DiscoveryHeartbeat():
                self._handle_discovery(message, known_before)
            case DiscoveryHeartbeatResponse():
                self._handle_discovery_response(message)
            case RequestVote():
                self._handle_request_vote(message, known_before)
            case RequestVoteResponse():
                self._handle_request_vote_response(message)

    def _fall_silent(self) -> None:
        self._become_follower()
        self.leader_id = None
        self.leader_heard_s = None
        self.membership.leader_view = None
        self.transport.cancel_timer(ELECTION_TIMER)
        self.transport.drop_replies()

    # ---- all roles: terms and majorities -------------------------------------------------------------------

    def adopt_term(self, term: int) -> None:
        """Enter a higher term as a follower that has not voted. Do nothing if it is not higher."""
        if term <= self.persistent.current_term:
            return
        self.persistent.current_term = term
        self.persistent.voted_for = None
        self.leader_id = None
        self.leader_heard_s = None
        if self.state is not RaftState.FOLLOWER:
            self._become_follower()
            self._restart_election_timer()

    def active_nodes(self) -> frozenset[int]:
        """Return the ids of the members that are considered active: in classic mode, all members."""
        if self.config.is_classic_mode():
            return self.membership.known
        if self.leadership is not None:
            return self.membership.detected()
        return self.membership.active_for_follower(self.lease_start_s())

    def electorate(self) -> frozenset[int]:
        """Return the ids of the nodes of which a majority decides, including this node.

        These are all members in classic mode, and the members seen active in fault-tolerant mode.
        """
        if self.election is not None and self.config.is_fault_tolerant_mode():
            return (self.membership.known & self.election.seen) | {self.node_id}
        return self.active_nodes()

    def has_majority(self, nodes: Iterable[int], electorate: frozenset[int]) -> bool:
        """Whether `nodes` are more than half of `electorate`.

        An electorate of one node has no majority, unless the members were set to this node alone.
        """
        if len(electorate) < 2 and not self.membership.is_single_node:
            return False
        return len(electorate.intersection(nodes)) >= majority_of(len(electorate))

    def hears_leader(self) -> bool:
        """Whether this node leads, or heard its leader within the shortest election timeout."""
        if self.state is RaftState.LEADER:
            return True
        heard_s = self.leader_heard_s
        return heard_s is not None and (
            self.transport.now_s() - heard_s < self.config.election_timeout_min_ms / 1000
        )

    def lease_start_s(self) -> float:
        """Return the earliest time (s) of answers and reports that are still valid."""
        lease_ms = max(self.config.election_timeout_max_ms, self.config.get_failure_config().get_timeout_ms())
        return self.transport.now_s() - lease_ms / 1000

    def log(self, level: int, text: str, *arguments: object) -> None:
        """Log a line about this node, if the configuration enables that level."""
        lowest = self.config.log_level
        if lowest is not None and level >= logging.getLevelNamesMapping()[lowest]:
            _logger.log(level, "Raft node %s: " + text, self.node_id, *arguments)

    # ---- followers -----------------------------------------------------------------------------------------

    def _become_follower(self) -> None:
        self._stop_discovery()
        self.election = None
        self.leadership = None
        self.transport.cancel_timer(HEARTBEAT_TIMER)

    def _handle_append_entries(self, message: AppendEntries) -> None:
        term, log, leader = self.persistent.current_term, self.persistent.log, message.leader_id
        if message.term < term or (message.term == term and self.state is RaftState.LEADER):
            self._reply(AppendEntriesResponse(term, False, self.node_id, 0), leader)
            return
        self.adopt_term(message.term)
        if self.leader_id != leader:
            self.log(logging.INFO, "following node %s in term %s", leader, message.term)
        self._become_follower()
        self.leader_id = leader
        self.leader_heard_s = self.transport.now_s()
        self._restart_election_timer()
        if message.active_nodes_count is not None:
            nodes = message.active_nodes_list
            self.membership.leader_view = LeaderView(
                message.active_nodes_count, None if nodes is None else frozenset(nodes), self.leader_heard_s
            )
        leader_log = message.log()
        accepted = True
        if log.contradicts(leader_log):
            accepted = self.config.is_fault_tolerant_mode()
            self.log(
                logging.WARNING,
                "the log of leader %s lacks entries committed here (up to entry %s): %s",
                leader,
                log.base_index,
                "replacing them" if accepted else "keeping them. Do all nodes know the same members?",
            )
        if accepted:
            log.follow(leader_log)
        match_index = leader_log.last_index if accepted else 0
        self._reply(AppendEntriesResponse(message.term, accepted, self.node_id, match_index), leader)

    def _handle_discovery(self, message: DiscoveryHeartbeat, known_before: frozenset[int]) -> None:
        if self.node_id in message.answered:
            return
        would_vote = self._would_vote(message, known_before)
        if would_vote and self.discovery is None:
            self._restart_election_timer()  # let the other node go first
        self._reply(
            DiscoveryHeartbeatResponse(self.persistent.current_term, self.node_id, would_vote),
            message.sender_id,
        )

    def _handle_request_vote(self, message: RequestVote, known_before: frozenset[int]) -> None:
        persistent = self.persistent
        granted = False
        if message.term >= persistent.current_term and not self.hears_leader():
            self.adopt_term(message.term)
            granted = persistent.voted_for in (None, message.candidate_id) and self._would_vote(
                message, known_before
            )
            if granted:
                persistent.voted_for = message.candidate_id
                self._stop_discovery()
                self._restart_election_timer()
        self._reply(RequestVoteResponse(persistent.current_term, granted, self.node_id), message.candidate_id)

    def _would_vote(self, message: RequestVote | DiscoveryHeartbeat, known_before: frozenset[int]) -> bool:
        """Whether this node hears no leader, and the sender knows all members and its log is up to date."""
        if self.hears_leader():
            return False
        if not self.membership.is_fixed:
            sender_knows = {message.sender_id, *(message.known_nodes or known_before)}
            if not known_before <= sender_knows:
                return False
        return self.persistent.log.is_up_to_date(message.last_log_index, message.last_log_term)

    # ---- candidates: discovery, then election --------------------------------------------------------------

    def _handle_election_timeout(self) -> None:
        if self.state is RaftState.LEADER:
            return
        self._become_follower()
        self.leader_id = None
        self.leader_heard_s = None
        self.discovery = Discovery(_DISCOVERY_ROUNDS)
        self.log(logging.DEBUG, "no leader heard, starting discovery")
        if self.membership.is_single_node:
            self._finish_discovery()
        else:
            self._continue_discovery()

    def _continue_discovery(self) -> None:
        """Start the next round of requests. After the last one, decide whether to become a candidate."""
        discovery = self.discovery
        if discovery is None:
            return
        if discovery.rounds_left == 0:
            self._finish_discovery()
            return
        discovery.rounds_left -= 1
        log = self.persistent.log
        self.transport.broadcast(
            DiscoveryHeartbeat(
                self.persistent.current_term,
                self.node_id,
                log.last_index,
                log.last_term,
                answered=sorted(discovery.answered),
            )
        )
        all_rounds_ms = max(
            self.config.get_failure_config().get_timeout_ms(), self.config.election_timeout_min_ms
        )
        self.transport.restart_timer(
            DISCOVERY_TIMER,
            all_rounds_ms / 1000 / _DISCOVERY_ROUNDS * self.transport.random.uniform(*_JITTER),
        )

    def _handle_discovery_response(self, message: DiscoveryHeartbeatResponse) -> None:
        self.adopt_term(message.term)
        discovery = self.discovery
        if discovery is None:
            return
        discovery.answered.add(message.responder_id)
        if message.would_vote:
            discovery.willing.add(message.responder_id)
        if not self.membership.is_fixed:
            return  # unknown nodes may still answer
        if discovery.answered >= self.membership.others or (
            self.config.is_classic_mode()
            and self.has_majority({*discovery.willing, self.node_id}, self.membership.known)
        ):
            self._finish_discovery()

    def _stop_discovery(self) -> None:
        if self.discovery is not None:
            self.discovery = None
            self.transport.cancel_timer(DISCOVERY_TIMER)

    def _finish_discovery(self) -> None:
        """Become a candidate if a majority would vote for this node."""
        discovery = self.discovery
        assert discovery is not None
        self._stop_discovery()
        self._restart_election_timer()
        seen = {*discovery.answered, self.node_id}
        electorate = self.membership.known if self.config.is_classic_mode() else frozenset(seen)
        if not self.has_majority({*discovery.willing, self.node_id}, electorate):
            return
        persistent = self.persistent
        persistent.current_term = next_own_term(persistent.current_term, self.node_id)
        persistent.voted_for = self.node_id
        self.leader_id = None
        self.election = Election(seen, {self.node_id})
        self.log(logging.INFO, "candidate in term %s, %s nodes active", persistent.current_term, len(seen))
        if self.has_majority(self.election.votes, self.electorate()):
            self._become_leader(self.election)
        else:
            self._request_votes()

    def _request_votes(self) -> None:
        """Ask all nodes for their vote. Repeat this at each heartbeat until the election is decided."""
        log = self.persistent.log
        self.transport.broadcast(
            RequestVote(self.persistent.current_term, self.node_id, log.last_index, log.last_term)
        )
        self._restart_heartbeat_timer()

    def _handle_request_vote_response(self, message: RequestVoteResponse) -> None:
        self.adopt_term(message.term)
        election = self.election
        if election is None or not message.vote_granted or message.term != self.persistent.current_term:
            return
        election.seen.add(message.voter_id)
        election.votes.add(message.voter_id)
        if self.has_majority(election.votes, self.electorate()):
            self._become_leader(election)

    # ---- leaders -------------------------------------------------------------------------------------------

    def _become_leader(self, election: Election) -> None:
        term = self.persistent.current_term
        self.election = None
        self.leader_id = self.node_id
        self.leadership = Leadership(self.node_id, term, self.transport.now_s(), election.votes)
        self.membership.start_leading(election.seen)
        self.transport.cancel_timer(ELECTION_TIMER)
        self.log(logging.INFO, "leader of term %s with %s votes", term, len(election.votes))
        # Entries of earlier terms are committed with one of this term (Raft, section 8).
        self._append(Entry(term, None, None))
        self._restart_heartbeat_timer()

    def propose(self, name: str, value: Any) -> bool:
        """Append an entry, unless the variable already has that value. Return False if not the leader."""
        if self.leadership is None:
            return False
        if not same_value(self.persistent.log.latest_values().get(name), value):
            self._append(Entry(self.persistent.current_term, name, value))
        return True

    def _append(self, entry: Entry) -> None:
        self.persistent.log.append(entry)
        self._commit_majority()
        self._send_append_entries()

    def _handle_heartbeat_timer(self) -> None:
        """Send a heartbeat, or step down if too few nodes answer."""
        if self.leadership is None:
            return
        electorate = self.electorate()
        present: Iterable[int] = electorate
        if self.config.is_classic_mode():
            present = self.leadership.heard_since(self.lease_start_s())
        if self.has_majority(present, electorate):
            self.membership.heartbeat_sent()
            self._commit_majority()
            self._send_append_entries()
            self._restart_heartbeat_timer()
        else:
            self.log(logging.INFO, "stepping down: not enough nodes answer")
            self._become_follower()
            self.leader_id = None
            self._restart_election_timer()

    def _send_append_entries(self) -> None:
        assert self.leadership is not None
        log = self.persistent.log
        active = sorted(self.active_nodes())
        self.leadership.sent_s = self.transport.now_s()
        self.transport.broadcast(
            AppendEntries(
                self.persistent.current_term,
                self.node_id,
                {**dict.fromkeys(self.config.get_consensus_variables()), **log.values},
                log.last_index,
                len(active),
                active,
                log.base_index,
                log.base_term,
                log.entries,
            )
        )

    def _handle_append_entries_response(self, message: AppendEntriesResponse) -> None:
        self.adopt_term(message.term)
        leadership = self.leadership
        if leadership is None or message.term != self.persistent.current_term:
            return
        follower, now_s = message.follower_id, self.transport.now_s()
        leadership.heard(follower, now_s)
        self.membership.detector.record_heartbeat_response(follower, True, (now_s - leadership.sent_s) * 1000)
        if message.success:
            leadership.matches(follower, message.term_number)
            self._commit_majority()

    def _commit_majority(self) -> None:
        """Commit the entries that a majority has, if this node is the leader."""
        if self.leadership is None:
            return
        electorate = self.electorate()
        if self.has_majority(electorate, electorate):
            log = self.persistent.log
            log.commit(self.leadership.committable(log, electorate))

    # ---- timers and replies --------------------------------------------------------------------------------

    def _restart_election_timer(self) -> None:
        low_ms, high_ms = self.config.election_timeout_min_ms, self.config.election_timeout_max_ms
        self.transport.restart_timer(ELECTION_TIMER, self.transport.random.uniform(low_ms, high_ms) / 1000)

    def _restart_heartbeat_timer(self) -> None:
        jitter = self.transport.random.uniform(*_JITTER)
        self.transport.restart_timer(HEARTBEAT_TIMER, self.config.heartbeat_interval_ms / 1000 * jitter)

    def _reply(self, message: RaftMessage, destination: int) -> None:
        spread_s = min(_REPLY_SPREAD * self.config.heartbeat_interval_ms / 1000, _REPLY_SPREAD_MAX_S)
        self.transport.reply(message, destination, self.transport.random.uniform(0, spread_s))
