"""Which nodes belong to the cluster and which of them are active, as one node sees it."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from gradysim.protocol.plugin.raft.failure_detection.failure_config import FailureConfig
from gradysim.protocol.plugin.raft.failure_detection.heartbeat_detector import HeartbeatDetector
from gradysim.protocol.plugin.raft.raft_message import RaftMessage


@dataclass(frozen=True)
class LeaderView:
    """Report of a leader about active nodes: how many, their ids if it sent them, and when (s)."""

    count: int
    nodes: frozenset[int] | None
    time_s: float


class MembershipView:
    """Members of the cluster. At first, only the node itself; then every node that it hears of.

    Attributes:
        known: Ids of all members, including the node itself.
        is_fixed: Whether `fix` has set the members. Other nodes are then ignored.
        cluster_id: Cluster of the node. Nodes with None form a cluster, too.
        detector: Detects failures by the answers that this node receives as the leader.
        leader_view: Latest report of the leader that this node follows, if any.
    """

    def __init__(self, own_id: int, config: FailureConfig, now_s: Callable[[], float]) -> None:
        self._own_id = own_id
        self._heard_clusters: dict[int, int | None] = {}
        self.known: frozenset[int] = frozenset({own_id})
        self.is_fixed = False
        self.cluster_id: int | None = None
        self.detector = HeartbeatDetector(config, (), get_current_time_callback=now_s)
        self.leader_view: LeaderView | None = None

    @property
    def others(self) -> frozenset[int]:
        """Ids of all members except the node itself."""
        return self.known - {self._own_id}

    @property
    def is_single_node(self) -> bool:
        """Whether the members were set to the node alone. It then needs no other node."""
        return self.is_fixed and len(self.known) == 1

    def fix(self, node_ids: Iterable[int]) -> None:
        """Set the members. The node itself is always a member."""
        self.is_fixed = True
        self._set_known(frozenset({*node_ids, self._own_id}))

    def learn(self, node_ids: Iterable[int]) -> None:
        """Add members, unless the members were set."""
        if not self.is_fixed:
            self._set_known(self.known.union(node_ids))

    def accepts(self, message: RaftMessage) -> bool:
        """Whether a message comes from another node that may be a member, and from the same cluster."""
        sender = message.sender_id
        if sender == self._own_id or (self.is_fixed and sender not in self.known):
            return False
        self._heard_clusters[sender] = message.cluster_id
        return message.cluster_id == self.cluster_id

    def shares_cluster_with(self, node_id: int) -> bool:
        """Whether a node is in the same cluster by its latest message, or is a member if it sent none."""
        if node_id == self._own_id or node_id not in self._heard_clusters:
            return node_id in self.known
        return self._heard_clusters[node_id] == self.cluster_id

    def start_leading(self, seen: Iterable[int]) -> None:
        """Restart the failure detection: nodes in `seen` are active, others failed until they answer."""
        seen = frozenset(seen)
        self.leader_view = None
        for node_id in self.others:
            if node_id in seen:
                self.detector.reset_node(node_id)
            else:
                self.detector.mark_failed(node_id)

    def heartbeat_sent(self) -> None:
        """Count a heartbeat to all members."""
        for node_id in self.others:
            self.detector.record_heartbeat_sent(node_id)
        self.detector.on_heartbeat_sent()

    def detected(self) -> frozenset[int]:
        """Return the ids of the members that the detector considers active, including the node itself."""
        return (self.known & self.detector.get_active_nodes()) | {self._own_id}

    def active_for_follower(self, since_s: float) -> frozenset[int]:
        """Return the active ids that the leader reported at `since_s` or later, or else those detected."""
        view = self.fresh_leader_view(since_s)
        if view is None or view.nodes is None:
            return self.detected()
        return (self.known & view.nodes) | {self._own_id}

    def fresh_leader_view(self, since_s: float) -> LeaderView | None:
        """Return the report of the leader if it came at `since_s` or later."""
        view = self.leader_view
        return view if view is not None and view.time_s >= since_s else None

    def _set_known(self, node_ids: frozenset[int]) -> None:
        for node_id in node_ids - self.known:
            self.detector.add_node(node_id)
        for node_id in self.known - node_ids:
            self.detector.remove_node(node_id)
        self.known = node_ids
