"""What is known about each node: who answered when, and who is taken for failed."""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum


class NodeStatus(Enum):
    """What a node is taken for.

    Attributes:
        UNKNOWN: Nothing is known about a node of that id.
    """

    ACTIVE = "active"
    FAILED = "failed"
    UNKNOWN = "unknown"


@dataclass
class _Record:
    status: NodeStatus = NodeStatus.ACTIVE
    consecutive_failures: int = 0
    consecutive_successes: int = 0
    # Silence is counted from here: the last answer, or when the node was first looked at.
    silent_since_s: float | None = None
    last_response_s: float | None = None


class FailureState:
    """Answers and failures of a set of nodes, active until shown otherwise. Times are seconds."""

    def __init__(self, known_nodes: Iterable[int]) -> None:
        self._records = {node_id: _Record() for node_id in known_nodes}

    def record_heartbeat_response(self, node_id: int, timestamp: float, success: bool) -> None:
        """Note that a node answered at `timestamp`, or failed to; no-op for a stranger."""
        record = self._records.get(node_id)
        if record is None:
            return
        if success:
            record.consecutive_successes += 1
            record.consecutive_failures = 0
            record.silent_since_s = record.last_response_s = timestamp
        else:
            record.consecutive_failures += 1
            record.consecutive_successes = 0

    def check_node_failure_with_timeout(
        self, node_id: int, failure_threshold: int, timeout_ms: int, current_time: float
    ) -> bool:
        """Look at a node: silence of more than `timeout_ms` is one failure, `failure_threshold` make it
        failed.

        A node that never answered is silent since it was first looked at.

        Returns:
            Whether the node has become failed by this look.
        """
        record = self._records.get(node_id)
        if record is None:
            return False
        if record.silent_since_s is None:
            record.silent_since_s = current_time
        if self.is_overdue(node_id, timeout_ms, current_time):
            record.consecutive_failures += 1
            record.consecutive_successes = 0
        return self.check_node_failure(node_id, failure_threshold)

    def check_node_failure(self, node_id: int, failure_threshold: int) -> bool:
        """Take an active node with `failure_threshold` failures in a row for failed; whether that is new."""
        record = self._records.get(node_id)
        if record is None or record.status is NodeStatus.FAILED:
            return False
        if record.consecutive_failures < failure_threshold:
            return False
        record.status = NodeStatus.FAILED
        return True

    def check_node_recovery(self, node_id: int, recovery_threshold: int) -> bool:
        """Take a failed node with `recovery_threshold` answers in a row for active; whether that is new."""
        record = self._records.get(node_id)
        if record is None or record.status is not NodeStatus.FAILED:
            return False
        if record.consecutive_successes < recovery_threshold:
            return False
        record.status = NodeStatus.ACTIVE
        return True

    def mark_failed(self, node_id: int) -> None:
        """Take a node for failed without a failure of its own: it was looked for and not found."""
        if node_id in self._records:
            self._records[node_id] = _Record(NodeStatus.FAILED)

    def get_failed_nodes(self) -> set[int]:
        """Ids of the nodes taken for failed."""
        return self._of_status(NodeStatus.FAILED)

    def get_active_nodes(self) -> set[int]:
        """Ids of the nodes taken for active."""
        return self._of_status(NodeStatus.ACTIVE)

    def get_all_nodes(self) -> set[int]:
        """Ids of all nodes."""
        return set(self._records)

    def get_node_status(self, node_id: int) -> NodeStatus:
        """What a node is taken for; UNKNOWN for a stranger."""
        record = self._records.get(node_id)
        return NodeStatus.UNKNOWN if record is None else record.status

    def is_node_failed(self, node_id: int) -> bool:
        """Whether the node is taken for failed; False for a stranger."""
        return self.get_node_status(node_id) is NodeStatus.FAILED

    def is_overdue(self, node_id: int, timeout_ms: int, current_time: float) -> bool:
        """Whether the node has been silent for more than `timeout_ms` at `current_time`."""
        record = self._records.get(node_id)
        if record is None or record.silent_since_s is None:
            return False
        return (current_time - record.silent_since_s) * 1000 > timeout_ms

    def get_statistics(self, node_id: int) -> dict[str, int | str]:
        """Consecutive failures and successes and status ("active", "failed"); empty for a stranger."""
        record = self._records.get(node_id)
        if record is None:
            return {}
        return {
            "consecutive_failures": record.consecutive_failures,
            "consecutive_successes": record.consecutive_successes,
            "status": record.status.value,
        }

    def get_timeout_statistics(self, node_id: int, current_time: float) -> dict[str, float]:
        """Time of the last answer (s), time since it (ms; both 0 if none), counters; empty for a stranger."""
        record = self._records.get(node_id)
        if record is None:
            return {}
        last = record.last_response_s
        return {
            "last_response_timestamp": 0 if last is None else last,
            "time_since_response_ms": 0 if last is None else (current_time - last) * 1000,
            "consecutive_failures": record.consecutive_failures,
            "consecutive_successes": record.consecutive_successes,
        }

    def add_node(self, node_id: int) -> None:
        """Begin to watch a node, taken for active; no-op if it is watched already."""
        self._records.setdefault(node_id, _Record())

    def remove_node(self, node_id: int) -> None:
        """Forget a node; no-op for a stranger."""
        self._records.pop(node_id, None)

    def reset_node(self, node_id: int) -> None:
        """Forget what is known about a node and take it for active; no-op for a stranger."""
        if node_id in self._records:
            self._records[node_id] = _Record()

    def _of_status(self, status: NodeStatus) -> set[int]:
        return {node_id for node_id, record in self._records.items() if record.status is status}
