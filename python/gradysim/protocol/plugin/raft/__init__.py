"""Raft consensus on the values of named variables."""

from gradysim.protocol.plugin.raft.failure_detection.failure_config import FailureConfig
from gradysim.protocol.plugin.raft.raft_config import RaftConfig, RaftMode
from gradysim.protocol.plugin.raft.raft_consensus import RaftConsensusPlugin
from gradysim.protocol.plugin.raft.raft_state import RaftState

__all__ = ["FailureConfig", "RaftConfig", "RaftConsensusPlugin", "RaftMode", "RaftState"]
