"""The state of one node: what its parts (following, voting, candidacy, office) share."""

import logging
from collections.abc import Iterable

from gradysim.protocol.plugin.raft.activity import Activity
from gradysim.protocol.plugin.raft.cluster import Cluster
from gradysim.protocol.plugin.raft.election import Discovery, Election
from gradysim.protocol.plugin.raft.environment import Environment
from gradysim.protocol.plugin.raft.leadership import Leadership
from gradysim.protocol.plugin.raft.membership import Membership, majority_of
from gradysim.protocol.plugin.raft.node_timers import DISCOVERY_TIMER, HEARTBEAT_TIMER, NodeTimers
from gradysim.protocol.plugin.raft.outbox import Outbox
from gradysim.protocol.plugin.raft.persistent_state import PersistentState
from gradysim.protocol.plugin.raft.raft_config import RaftConfig
from gradysim.protocol.plugin.raft.raft_state import RaftState

_logger = logging.getLogger(__name__)


class RaftCore:
    """What a node is and knows, and the steps that all its parts take.

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
        environment: Clock, timers, radio and chance.
        outbox: What it sends.
        leader_heard_s: When the leader was heard last; s.
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
        self.environment = environment
        self.outbox = Outbox(environment, self.membership, self.cluster, self.timers)
        self.leader_heard_s: float | None = None

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
        return self.environment.now_s() - lease_ms / 1000

    def now_s(self) -> float:
        """Time in seconds."""
        return self.environment.now_s()

    def has_majority(self, nodes: Iterable[int], electorate: frozenset[int]) -> bool:
        """Whether `nodes` are most of the electorate. One node alone is none, unless set to be alone."""
        if len(electorate) < 2 and not self.membership.is_alone_by_choice:
            return False
        return len(electorate.intersection(nodes)) >= majority_of(len(electorate))

    def hears_leader(self) -> bool:
        """Whether this node leads, or has heard from its leader within the shortest election timeout."""
        if self.state is RaftState.LEADER:
            return True
        heard_s = self.leader_heard_s
        return (
            heard_s is not None
            and self.environment.now_s() - heard_s < self.config.election_timeout_min_ms / 1000
        )

    def adopt_term(self, term: int) -> None:
        """Go to a higher term, as a follower that has not voted yet; no-op for one that is not higher."""
        if term <= self.persistent.current_term:
            return
        self.persistent.current_term = term
        self.persistent.voted_for = None
        self.leader_id = None
        self.leader_heard_s = None
        if self.state is not RaftState.FOLLOWER:
            self.become_follower()
            self.timers.restart_election()

    def become_follower(self) -> None:
        """Give up what it was on the way to, or was."""
        self.stop_discovery()
        self.state = RaftState.FOLLOWER
        self.election = None
        self.leadership = None
        self.timers.cancel(HEARTBEAT_TIMER)

    def stop_discovery(self) -> None:
        """Look round no more; no-op if it does not."""
        if self.discovery is not None:
            self.discovery = None
            self.timers.cancel(DISCOVERY_TIMER)

    def log(self, level: int, text: str, *arguments: object) -> None:
        """Log a line about this node, if the configuration wants lines of that level."""
        lowest = self.config.log_level
        if lowest is not None and level >= logging.getLevelNamesMapping()[lowest]:
            _logger.log(level, "Raft node %s: " + text, self.node_id, *arguments)
