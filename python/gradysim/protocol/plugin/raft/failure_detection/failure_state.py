"""Answers and status of each node."""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum


class NodeStatus(Enum):
    """Status of a node. UNKNOWN: no node with that id was added."""

    ACTIVE = "active"
    FAILED = "failed"
    UNKNOWN = "unknown"


@dataclass
class _Record:
    status: NodeStatus = NodeStatus.ACTIVE
    consecutive_failures: int = 0
    consecutive_successes: int = 0
    # Time of the last answer, or of the first check if there was none.
    silent_since_s: float | None = None
    last_response_s: float | None = None


class FailureState:
    """Answers and failures of a set of nodes, which are all active at first. Times are in seconds."""

    def __init__(self, known_nodes: Iterable[int]) -> None:
        self._records = {node_id: _Record() for node_id in known_nodes}

    def record_heartbeat_response(self, node_id: int, timestamp: float, success: bool) -> None:
        """Record that a node answered at `timestamp`, or failed to. Ignore unknown nodes."""
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
        """Count silence of more than `timeout_ms` as a failure, then do the same as `check_node_failure`.

        For a node that never answered, the silence starts at the first check.
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
        """Mark a node with `failure_threshold` failures in a row as failed. Return whether that is new."""
        record = self._records.get(node_id)
        if record is None or record.status is NodeStatus.FAILED:
            return False
        if record.consecutive_failures < failure_threshold:
            return False
        record.status = NodeStatus.FAILED
        return True

    def check_node_recovery(self, node_id: int, recovery_threshold: int) -> bool:
        """Mark a failed node with enough answers in a row as active. Return whether that is new."""
        record = self._records.get(node_id)
        if record is None or record.status is not NodeStatus.FAILED:
            return False
        if record.consecutive_successes < recovery_threshold:
            return False
        record.status = NodeStatus.ACTIVE
        return True

    def mark_failed(self, node_id: int) -> None:
        """Mark a node as failed until it answers. Ignore unknown nodes."""
        if node_id in self._records:
            self._records[node_id] = _Record(NodeStatus.FAILED)

    def get_failed_nodes(self) -> set[int]:
        """Return the ids of the failed nodes."""
        return self._of_status(NodeStatus.FAILED)

    def get_active_nodes(self) -> set[int]:
        """Return the ids of the active nodes."""
        return self._of_status(NodeStatus.ACTIVE)

    def get_all_nodes(self) -> set[int]:
        """Return the ids of all nodes."""
        return set(self._records)

    def get_node_status(self, node_id: int) -> NodeStatus:
        """Return the status of a node."""
        record = self._records.get(node_id)
        return NodeStatus.UNKNOWN if record is None else record.status

    def is_node_failed(self, node_id: int) -> bool:
        """Whether the node has failed. False for an unknown node."""
        return self.get_node_status(node_id) is NodeStatus.FAILED

    def is_overdue(self, node_id: int, timeout_ms: int, current_time: float) -> bool:
        """Whether the node has been silent for more than `timeout_ms` at `current_time`."""
        record = self._records.get(node_id)
        if record is None or record.silent_since_s is None:
            return False
        return (current_time - record.silent_since_s) * 1000 > timeout_ms

    def get_statistics(self, node_id: int) -> dict[str, int | str]:
        """Return the consecutive failures and successes and the status; empty for an unknown node."""
        record = self._records.get(node_id)
        if record is None:
            return {}
        return {
            "consecutive_failures": record.consecutive_failures,
            "consecutive_successes": record.consecutive_successes,
            "status": record.status.value,
        }

    def get_timeout_statistics(self, node_id: int, current_time: float) -> dict[str, float]:
        """Return the time of the last answer (s), the time since (ms), and the counters.

        Both times are 0 if there was no answer. The result is empty for an unknown node.
        """
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
        """Add an active node. Do nothing if it was added already."""
        self._records.setdefault(node_id, _Record())

    def remove_node(self, node_id: int) -> None:
        """Remove a node. Ignore unknown nodes."""
        self._records.pop(node_id, None)

    def reset_node(self, node_id: int) -> None:
        """Mark a node as active and clear its counters. Ignore unknown nodes."""
        if node_id in self._records:
            self._records[node_id] = _Record()

    def _of_status(self, status: NodeStatus) -> set[int]:
        return {node_id for node_id, record in self._records.items() if record.status is status}
