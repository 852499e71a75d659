"""Failure detection by answers to heartbeats."""

from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any

from gradysim.protocol.plugin.raft.failure_detection.failure_config import FailureConfig
from gradysim.protocol.plugin.raft.failure_detection.failure_state import FailureState

_REMEMBERED_RESPONSE_TIMES = 10
_SHOWN_RESPONSE_TIMES = 5


@dataclass
class _History:
    failure_count: int = 0
    recovery_count: int = 0
    last_failure_s: float | None = None
    last_recovery_s: float | None = None
    response_times_ms: deque[float] = field(default_factory=lambda: deque(maxlen=_REMEMBERED_RESPONSE_TIMES))


class HeartbeatDetector:
    """Detects failed and recovered nodes by the rules of a `FailureConfig`.

    The sender of heartbeats calls `record_heartbeat_sent` for each receiver, `on_heartbeat_sent` once per
    heartbeat, and `record_heartbeat_response` for each answer.
    """

    def __init__(
        self,
        config: FailureConfig,
        known_nodes: Iterable[int],
        on_failure_callback: Callable[[int], None] | None = None,
        on_recovery_callback: Callable[[int], None] | None = None,
        get_current_time_callback: Callable[[], float] | None = None,
    ) -> None:
        """Create a detector for nodes with these ids, all active at first.

        The callbacks get the id of a node that has failed or recovered. Without a callback for the current
        time (s), there are no timeouts: only answers recorded as failures count.
        """
        self._config = config
        self._state = FailureState(known_nodes)
        self._histories = {node_id: _History() for node_id in self._state.get_all_nodes()}
        self._on_failure = on_failure_callback
        self._on_recovery = on_recovery_callback
        self._now_s = get_current_time_callback or (lambda: 0.0)
        self._heartbeats = 0
        self._sent = 0
        self._successes = 0
        self._failures = 0
        self._check_time_s: float | None = None
        self._latency_ms = 0.0

    def record_heartbeat_sent(self, node_id: int) -> None:
        """Count a heartbeat to that node."""
        if node_id in self._histories:
            self._sent += 1

    def record_heartbeat_response(
        self, node_id: int, success: bool, response_time_ms: float | None = None
    ) -> None:
        """Record an answer, and the time from the heartbeat to it, if known. Ignore unknown nodes.

        Use `success=False` if it is known that the node did not answer.
        """
        history = self._histories.get(node_id)
        if history is None:
            return
        if success:
            self._successes += 1
            if response_time_ms is not None:
                history.response_times_ms.append(response_time_ms)
        else:
            self._failures += 1
        self._state.record_heartbeat_response(node_id, self._now_s(), success)
        if success and self._state.check_node_recovery(node_id, self._config.recovery_threshold):
            history.recovery_count += 1
            history.last_recovery_s = self._now_s()
            if self._on_recovery is not None:
                self._on_recovery(node_id)

    def on_heartbeat_sent(self) -> None:
        """Count a heartbeat. Every `detection_interval` heartbeats check all nodes."""
        self._heartbeats += 1
        if self._heartbeats % self._config.detection_interval == 0:
            self._check_all()

    def mark_failed(self, node_id: int) -> None:
        """Mark a node as failed until it answers."""
        self._state.mark_failed(node_id)

    def get_failed_nodes(self) -> set[int]:
        """Return the ids of the failed nodes."""
        return self._state.get_failed_nodes()

    def get_active_nodes(self) -> set[int]:
        """Return the ids of the active nodes."""
        return self._state.get_active_nodes()

    def is_node_failed(self, node_id: int) -> bool:
        """Whether the node has failed. False for an unknown node."""
        return self._state.is_node_failed(node_id)

    def get_node_statistics(self, node_id: int) -> dict[str, int | str]:
        """Return `FailureState.get_statistics`."""
        return self._state.get_statistics(node_id)

    def get_node_timeout_statistics(self, node_id: int) -> dict[str, float]:
        """Return `FailureState.get_timeout_statistics` at the current time."""
        return self._state.get_timeout_statistics(node_id, self._now_s())

    def add_node(self, node_id: int) -> None:
        """Add an active node. Do nothing if it was added already."""
        self._state.add_node(node_id)
        self._histories.setdefault(node_id, _History())

    def remove_node(self, node_id: int) -> None:
        """Remove a node. Ignore unknown nodes."""
        self._state.remove_node(node_id)
        self._histories.pop(node_id, None)

    def reset_node(self, node_id: int) -> None:
        """Mark a node as active and clear its counters. Ignore unknown nodes."""
        self._state.reset_node(node_id)

    def get_detection_summary(self) -> dict[str, Any]:
        """Return the settings, the numbers of active and failed nodes, and details of each node."""
        return {
            "enabled": True,
            "heartbeat_counter": self._heartbeats,
            **self._rules(),
            "total_nodes": len(self._histories),
            "active_nodes": len(self.get_active_nodes()),
            "failed_nodes": len(self.get_failed_nodes()),
            "performance": self._performance(),
            "detection_stats": self._detections(),
            "node_details": {node_id: self._details(node_id) for node_id in sorted(self._histories)},
        }

    def get_detection_metrics(self) -> dict[str, Any]:
        """Return counters and times of the detection and of each node."""
        return {
            "performance": self._performance(),
            "detection": {
                **self._detections(),
                "heartbeat_counter": self._heartbeats,
                "detection_interval": self._config.detection_interval,
            },
            "configuration": self._rules(),
            "node_histories": {node_id: self._history(node_id) for node_id in sorted(self._histories)},
        }

    def _check_all(self) -> None:
        now_s = self._now_s()
        if self._check_time_s is not None:
            self._latency_ms = (now_s - self._check_time_s) * 1000
        self._check_time_s = now_s
        for node_id, history in list(self._histories.items()):
            if self._state.check_node_failure_with_timeout(
                node_id, self._config.failure_threshold, self._config.get_timeout_ms(), now_s
            ):
                history.failure_count += 1
                history.last_failure_s = now_s
                if self._on_failure is not None:
                    self._on_failure(node_id)

    def _rules(self) -> dict[str, int]:
        return {
            "detection_interval": self._config.detection_interval,
            "failure_threshold": self._config.failure_threshold,
            "recovery_threshold": self._config.recovery_threshold,
            "timeout_ms": self._config.get_timeout_ms(),
        }

    def _performance(self) -> dict[str, float]:
        total = self._successes + self._failures
        times_ms = [time for history in self._histories.values() for time in history.response_times_ms]
        return {
            "total_heartbeats_sent": self._sent,
            "total_responses_received": total,
            "total_successful_responses": self._successes,
            "total_failed_responses": self._failures,
            "success_rate_percent": 100.0 * self._successes / total if total else 0.0,
            "failure_rate_percent": 100.0 * self._failures / total if total else 0.0,
            "average_response_time_ms": sum(times_ms) / len(times_ms) if times_ms else 0.0,
            "detection_latency_ms": self._latency_ms,
        }

    def _detections(self) -> dict[str, int]:
        histories = self._histories.values()
        return {
            "total_failures_detected": sum(history.failure_count for history in histories),
            "total_recoveries_detected": sum(history.recovery_count for history in histories),
        }

    def _details(self, node_id: int) -> dict[str, Any]:
        now_s = self._now_s()
        return {
            **self._history(node_id),
            **self._state.get_timeout_statistics(node_id, now_s),
            "status": self._state.get_node_status(node_id).name,
            "timeout_exceeded": self._state.is_overdue(node_id, self._config.get_timeout_ms(), now_s),
        }

    def _history(self, node_id: int) -> dict[str, Any]:
        history, now_s = self._histories[node_id], self._now_s()
        shown: dict[str, Any] = {
            "failure_count": history.failure_count,
            "recovery_count": history.recovery_count,
            "last_failure": history.last_failure_s,
            "last_recovery": history.last_recovery_s,
            "recent_response_times": list(history.response_times_ms)[-_SHOWN_RESPONSE_TIMES:],
        }
        if history.last_failure_s is not None:
            shown["time_since_last_failure"] = (now_s - history.last_failure_s) * 1000
        if history.last_recovery_s is not None:
            shown["time_since_last_recovery"] = (now_s - history.last_recovery_s) * 1000
        return shown
