"""Detection of failed nodes by their answers to heartbeats."""

from gradysim.protocol.plugin.raft.failure_detection.failure_config import FailureConfig
from gradysim.protocol.plugin.raft.failure_detection.failure_state import FailureState, NodeStatus
from gradysim.protocol.plugin.raft.failure_detection.heartbeat_detector import HeartbeatDetector

__all__ = ["FailureConfig", "FailureState", "HeartbeatDetector", "NodeStatus"]
