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

from gradysim.protocol.plugin.raft.activity import Activity, SharedView
from gradysim.protocol.plugin.raft.cluster import Cluster
from gradysim.protocol.plugin.raft.election import Discovery, Election
from gradysim.protocol.plugin.raft.environment import Environment
from gradysim.protocol.plugin.raft.leadership import Leadership
from gradysim.protocol.plugin.raft.membership import Membership, majority_of
from gradysim.protocol.plugin.raft.node_timers import (
    DISCOVERY_ROUNDS,
    DISCOVERY_TIMER,
    ELECTION_TIMER,
    HEARTBEAT_TIMER,
    REPLY_TIMER,
    NodeTimers,
)
from gradysim.protocol.plugin.raft.outbox import Outbox
from gradysim.protocol.plugin.raft.persistent_state import PersistentState
from gradysim.protocol.plugin.raft.raft_config import RaftConfig
from gradysim.protocol.plugin.raft.raft_log import Entry
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
from gradysim.protocol.plugin.raft.term import next_own_term
from gradysim.protocol.plugin.raft.value import same_value

_logger = logging.getLogger(__name__)


class RaftNode:
    """One member of the cluster.

    Attributes:
        state: Follower, candidate or leader.
        persistent: What outlives a crash.
        membership: Who counts.
        cluster: Which of those in reach are heard.
        activity: Who is taken for active.
        leader_id: The leader of the present term, if one is known and was heard lately.
        is_running: Between `start` and `stop`.
        is_active: False while `set_active` keeps it silent and deaf.
        timers: Its timers.
        discovery: While it looks round.
        election: While it is a candidate.
        leadership: While it is the leader.
    """

    def __init__(
        self, config: RaftConfig, environment: Environment, persistent: PersistentState | None = None
    ) -> None:
        """Make a node that begins anew, or goes on from what it knew before a crash."""
        self.config = config
        self.node_id = environment.node_id
        self.persistent = persistent or PersistentState()
        self.membership = Membership(self.node_id)
        self.cluster = Cluster()
        self.activity = Activity(
            self.node_id, self.membership, config.get_failure_config(), environment.now_s
        )
        self.state = RaftState.FOLLOWER
        self.leader_id: int | None = None
        self.is_running = False
        self.is_active = True
        self.timers = NodeTimers(config, environment)
        self.discovery: Discovery | None = None
        self.election: Election | None = None
        self.leadership: Leadership | None = None
        self._environment = environment
        self._outbox = Outbox(environment, self.membership, self.cluster, self.timers)
        self._leader_heard_s: float | None = None

    # ---- what its owner does -------------------------------------------------------------------------------

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
            self._adopt_term(self.persistent.current_term + 1)
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
        self._commit_what_can_be()

    def propose(self, name: str, value: Any) -> bool:
        """Add an entry to the log; False unless this node leads. A value that holds already needs none."""
        if self.leadership is None:
            return False
        log = self.persistent.log
        if same_value(log.latest_values().get(name), value):
            return True
        log.append(Entry(self.persistent.current_term, name, value))
        self._commit_what_can_be()
        self._send_entries()
        return True

    def send_text(self, text: str) -> None:
        """Broadcast something that is no message of the consensus."""
        if self.is_active:
            self._environment.send(text, None)

    # ---- what it knows -------------------------------------------------------------------------------------

    def electorate(self) -> frozenset[int]:
        """Ids of the nodes whose majority decides, the own one among them.

        In classic mode the members, in fault-tolerant mode those of them that are seen active.
        """
        if self.config.is_classic_mode():
            return self.membership.known
        if self.election is not None:
            return (self.membership.known & self.election.seen) | {self.node_id}
        return self.active_nodes()

    def active_nodes(self) -> frozenset[int]:
        """Ids of the members that are taken for active; in classic mode that is all of them."""
        if self.config.is_classic_mode():
            return self.membership.known
        if self.leadership is not None:
            return self.activity.detected()
        return self.activity.seen_by_follower(self.lease_start_s())

    def lease_start_s(self) -> float:
        """Time until which back what was heard counts as news; s."""
        lease_ms = max(self.config.election_timeout_max_ms, self.config.get_failure_config().get_timeout_ms())
        return self._environment.now_s() - lease_ms / 1000

    def now_s(self) -> float:
        """Time in seconds."""
        return self._environment.now_s()

    def has_majority(self, nodes: Iterable[int], electorate: frozenset[int]) -> bool:
        """Whether `nodes` are most of the electorate. One node alone is none, unless set to be alone."""
        if len(electorate) < 2 and not self.membership.is_alone_by_choice:
            return False
        return len(electorate.intersection(nodes)) >= majority_of(len(electorate))

    # ---- timers --------------------------------------------------------------------------------------------

    def handle_timer(self, name: str) -> None:
        """One of the node's timers is due."""
        self.timers.pending.discard(name)
        if not (self.is_running and self.is_active):
            return
        if name == ELECTION_TIMER:
            self._handle_election_timeout()
        elif name == DISCOVERY_TIMER:
            self._handle_discovery_timeout()
        elif name == HEARTBEAT_TIMER:
            self._handle_heartbeat()
        elif name == REPLY_TIMER:
            self._outbox.send_reply()

    def _handle_election_timeout(self) -> None:
        if self.state is RaftState.LEADER:
            return
        self._become_follower()
        self.leader_id = None
        self._leader_heard_s = None
        self.discovery = Discovery(DISCOVERY_ROUNDS)
        self._log(logging.DEBUG, "no leader heard, looking round")
        if self.membership.is_alone_by_choice:
            self._conclude_discovery()
        else:
            self._handle_discovery_timeout()

    def _handle_discovery_timeout(self) -> None:
        discovery = self.discovery
        if discovery is None:
            return
        if discovery.rounds_left == 0:
            self._conclude_discovery()
            return
        discovery.rounds_left -= 1
        log = self.persistent.log
        self._outbox.broadcast(
            DiscoveryHeartbeat(
                self.persistent.current_term,
                self.node_id,
                log.last_index,
                log.last_term,
                answered=sorted(discovery.answered),
            )
        )
        self.timers.restart_discovery_round()

    def _handle_heartbeat(self) -> None:
        if self.election is not None:
            self._request_votes()
        elif self.leadership is not None:
            if self._leads_enough():
                self.activity.heartbeat_sent()
                self._commit_what_can_be()
                self._send_entries()
                self.timers.restart_heartbeat()
            else:
                self._log(logging.INFO, "resigning: not enough nodes answer")
                self._become_follower()
                self.leader_id = None
                self.timers.restart_election()

    def _leads_enough(self) -> bool:
        """Whether the followers that a leader needs are still there."""
        assert self.leadership is not None
        electorate = self.electorate()
        if self.config.is_classic_mode():
            return self.has_majority(self.leadership.heard_since(self.lease_start_s()), electorate)
        return self.has_majority(electorate, electorate)

    # ---- messages ------------------------------------------------------------------------------------------

    def handle_message(self, text: str) -> None:
        """A message has arrived. What is not one is ignored."""
        if not (self.is_running and self.is_active):
            return
        try:
            message = parse_message(text)
        except ValueError as error:
            self._log(logging.WARNING, "ignoring a message: %s", error)
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
                self._handle_entries(message)
            case AppendEntriesResponse():
                self._handle_entries_response(message)
            case DiscoveryHeartbeat():
                if self.node_id not in message.answered:
                    would_vote = self._would_vote(message, knew)
                    if would_vote and self.discovery is None:
                        self.timers.restart_election()  # the asking node goes first
                    self._outbox.reply(
                        DiscoveryHeartbeatResponse(self.persistent.current_term, self.node_id, would_vote),
                        sender,
                    )
            case DiscoveryHeartbeatResponse():
                self._handle_discovery_response(message)
            case RequestVote():
                self._handle_vote_request(message, knew)
            case RequestVoteResponse():
                self._handle_vote(message)

    def _handle_entries(self, message: AppendEntries) -> None:
        persistent = self.persistent
        leader = message.leader_id
        if message.term < persistent.current_term or (
            message.term == persistent.current_term and self.state is RaftState.LEADER
        ):
            self._outbox.reply(AppendEntriesResponse(persistent.current_term, False, self.node_id, 0), leader)
            return
        self._adopt_term(message.term)
        if self.leader_id != leader:
            self._log(logging.INFO, "following node %s in term %s", leader, message.term)
        self._become_follower()
        self.leader_id = leader
        self._leader_heard_s = self._environment.now_s()
        self.timers.restart_election()
        if message.active_nodes_count is not None:
            nodes = message.active_nodes_list
            self.activity.shared = SharedView(
                message.active_nodes_count, None if nodes is None else frozenset(nodes), self._leader_heard_s
            )
        log, theirs = persistent.log, message.log()
        accepted = True
        if log.contradicts(theirs):
            accepted = self.config.is_fault_tolerant_mode()
            self._log(
                logging.WARNING,
                "what was committed here up to entry %s is not in the log of leader %s: %s",
                log.base_index,
                leader,
                "giving it up" if accepted else "keeping it. Do all nodes know the same members?",
            )
        if accepted:
            log.follow(theirs)
        matched = theirs.last_index if accepted else 0
        self._outbox.reply(
            AppendEntriesResponse(persistent.current_term, accepted, self.node_id, matched), leader
        )

    def _handle_entries_response(self, message: AppendEntriesResponse) -> None:
        self._adopt_term(message.term)
        leadership = self.leadership
        if leadership is None or message.term != self.persistent.current_term:
            return
        follower, now_s = message.follower_id, self._environment.now_s()
        leadership.heard(follower, now_s)
        self.activity.detector.record_heartbeat_response(follower, True, (now_s - leadership.sent_s) * 1000)
        if message.success:
            leadership.matches(follower, message.term_number)
            self._commit_what_can_be()

    def _handle_discovery_response(self, message: DiscoveryHeartbeatResponse) -> None:
        self._adopt_term(message.term)
        discovery = self.discovery
        if discovery is None:
            return
        discovery.answered.add(message.responder_id)
        if message.would_vote:
            discovery.willing.add(message.responder_id)
        if not self.membership.is_fixed:
            return  # somebody unknown may answer yet
        known = self.membership.known
        if discovery.answered >= self.membership.others or (
            self.config.is_classic_mode() and self.has_majority({*discovery.willing, self.node_id}, known)
        ):
            self._conclude_discovery()

    def _conclude_discovery(self) -> None:
        discovery = self.discovery
        assert discovery is not None
        self.discovery = None
        self.timers.cancel(DISCOVERY_TIMER)
        self.timers.restart_election()
        seen = {*discovery.answered, self.node_id}
        electorate = self.membership.known if self.config.is_classic_mode() else frozenset(seen)
        if not self.has_majority({*discovery.willing, self.node_id}, electorate):
            return
        persistent = self.persistent
        persistent.current_term = next_own_term(persistent.current_term, self.node_id)
        persistent.voted_for = self.node_id
        self.leader_id = None
        self.state = RaftState.CANDIDATE
        self.election = Election(seen, {self.node_id})
        self._log(logging.INFO, "candidate in term %s, seeing %s nodes", persistent.current_term, len(seen))
        if not self._count_votes():
            self._request_votes()

    def _request_votes(self) -> None:
        log = self.persistent.log
        self._outbox.broadcast(
            RequestVote(self.persistent.current_term, self.node_id, log.last_index, log.last_term)
        )
        self.timers.restart_heartbeat()

    def _handle_vote_request(self, message: RequestVote, knew: frozenset[int]) -> None:
        persistent = self.persistent
        granted = False
        if message.term >= persistent.current_term and not self._hears_leader():
            self._adopt_term(message.term)
            granted = persistent.voted_for in (None, message.candidate_id) and self._would_vote(message, knew)
            if granted:
                persistent.voted_for = message.candidate_id
                self._stop_discovery()
                self.timers.restart_election()
        self._outbox.reply(
            RequestVoteResponse(persistent.current_term, granted, self.node_id), message.candidate_id
        )

    def _would_vote(self, message: RequestVote | DiscoveryHeartbeat, knew: frozenset[int]) -> bool:
        """Whether a node deserves a vote: no leader is there, its log is as good, its members are as many."""
        if self._hears_leader():
            return False
        if not self.membership.is_fixed and not knew <= {message.sender_id, *(message.known_nodes or knew)}:
            return False
        return self.persistent.log.is_up_to_date(message.last_log_index, message.last_log_term)

    def _hears_leader(self) -> bool:
        """Whether this node leads, or has heard from its leader within the shortest election timeout."""
        if self.state is RaftState.LEADER:
            return True
        heard_s = self._leader_heard_s
        return (
            heard_s is not None
            and self._environment.now_s() - heard_s < self.config.election_timeout_min_ms / 1000
        )

    def _handle_vote(self, message: RequestVoteResponse) -> None:
        self._adopt_term(message.term)
        if (
            self.election is not None
            and message.vote_granted
            and message.term == self.persistent.current_term
        ):
            self.election.seen.add(message.voter_id)
            self.election.votes.add(message.voter_id)
            self._count_votes()

    def _count_votes(self) -> bool:
        election = self.election
        assert election is not None
        if not self.has_majority(election.votes, self.electorate()):
            return False
        term, log = self.persistent.current_term, self.persistent.log
        self.election = None
        self.state = RaftState.LEADER
        self.leader_id = self.node_id
        self.leadership = Leadership(self.node_id, term, self._environment.now_s(), election.votes)
        self.activity.begin_to_lead(election.seen)
        self.timers.cancel(ELECTION_TIMER)
        self._log(logging.INFO, "leader of term %s with %s votes", term, len(election.votes))
        # Entries of earlier terms are committed with one of this term (Raft, section 8).
        log.append(Entry(term, None, None))
        self._commit_what_can_be()
        self._send_entries()
        self.timers.restart_heartbeat()
        return True

    # ---- steps ---------------------------------------------------------------------------------------------

    def _adopt_term(self, term: int) -> None:
        """Go to a higher term, as a follower that has not voted yet; no-op for one that is not higher."""
        if term <= self.persistent.current_term:
            return
        self.persistent.current_term = term
        self.persistent.voted_for = None
        self.leader_id = None
        self._leader_heard_s = None
        if self.state is not RaftState.FOLLOWER:
            self._become_follower()
            self.timers.restart_election()

    def _become_follower(self) -> None:
        self._stop_discovery()
        self.state = RaftState.FOLLOWER
        self.election = None
        self.leadership = None
        self.timers.cancel(HEARTBEAT_TIMER)

    def _stop_discovery(self) -> None:
        if self.discovery is not None:
            self.discovery = None
            self.timers.cancel(DISCOVERY_TIMER)

    def _fall_silent(self) -> None:
        self._become_follower()
        self.leader_id = None
        self._leader_heard_s = None
        self.activity.shared = None
        self.timers.cancel(ELECTION_TIMER)
        self._outbox.clear()

    def _commit_what_can_be(self) -> None:
        leadership = self.leadership
        if leadership is None:
            return
        electorate = self.electorate()
        if self.has_majority(electorate, electorate):
            self.persistent.log.commit(leadership.committable(self.persistent.log, electorate))

    def _send_entries(self) -> None:
        assert self.leadership is not None
        log = self.persistent.log
        active = sorted(self.active_nodes())
        self.leadership.sent_s = self._environment.now_s()
        self._outbox.broadcast(
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

    def _log(self, level: int, text: str, *arguments: object) -> None:
        lowest = self.config.log_level
        if lowest is not None and level >= logging.getLevelNamesMapping()[lowest]:
            _logger.log(level, "Raft node %s: " + text, self.node_id, *arguments)
