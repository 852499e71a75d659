"""Which nodes a node takes for active: what it detects itself and what its leader tells."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from gradysim.protocol.plugin.raft.failure_detection.failure_config import FailureConfig
from gradysim.protocol.plugin.raft.failure_detection.heartbeat_detector import HeartbeatDetector
from gradysim.protocol.plugin.raft.membership import Membership


@dataclass(frozen=True)
class SharedView:
    """What a leader told about the active nodes: how many, perhaps which, and when (s)."""

    count: int
    nodes: frozenset[int] | None
    time_s: float


class Activity:
    """Active and failed nodes as one node sees them.

    Attributes:
        detector: Fed by the answers that this node gets as leader.
        shared: The latest word of the leader that this node follows, if any.
    """

    def __init__(
        self,
        own_id: int,
        membership: Membership,
        config: FailureConfig,
        now_s: Callable[[], float],
    ) -> None:
        self._own_id = own_id
        self._membership = membership
        self.detector = HeartbeatDetector(config, membership.others, get_current_time_callback=now_s)
        self.shared: SharedView | None = None

    def watch_members(self) -> None:
        """Watch the present members and nobody else."""
        watched = self.detector.get_active_nodes() | self.detector.get_failed_nodes()
        for node_id in self._membership.others - watched:
            self.detector.add_node(node_id)
        for node_id in watched - self._membership.others:
            self.detector.remove_node(node_id)

    def begin_to_lead(self, seen: Iterable[int]) -> None:
        """Forget what was known: the nodes `seen` just now are active, others failed until they answer."""
        present = frozenset(seen)
        self.shared = None
        for node_id in self._membership.others:
            if node_id in present:
                self.detector.reset_node(node_id)
            else:
                self.detector.mark_failed(node_id)

    def heartbeat_sent(self) -> None:
        """Count a heartbeat to all members."""
        for node_id in self._membership.others:
            self.detector.record_heartbeat_sent(node_id)
        self.detector.on_heartbeat_sent()

    def detected(self) -> frozenset[int]:
        """Ids of the members that the detector takes for active, and the node itself."""
        return (self._membership.known & self.detector.get_active_nodes()) | {self._own_id}

    def seen_by_follower(self, fresh_since_s: float) -> frozenset[int]:
        """The same for a follower: the leader's list, if it has one that is not older than that."""
        shared = self.fresh_shared(fresh_since_s)
        if shared is None or shared.nodes is None:
            return self.detected()
        return (self._membership.known & shared.nodes) | {self._own_id}

    def fresh_shared(self, since_s: float) -> SharedView | None:
        """What the leader told, if that was at `since_s` or later."""
        return self.shared if self.shared is not None and self.shared.time_s >= since_s else None
