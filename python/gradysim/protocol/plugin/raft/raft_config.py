"""Settings of the Raft consensus."""

import random
from enum import Enum
from typing import Any, Self

from gradysim.protocol.checked_values import checked_number
from gradysim.protocol.plugin.raft.failure_detection.failure_config import FailureConfig

_LOG_LEVELS = ("DEBUG", "INFO", "WARNING", "ERROR", "CRITICAL")


class RaftMode(Enum):
    """Set of nodes of which an election or a commit needs a majority.

    Attributes:
        CLASSIC: All known nodes, as in the Raft paper.
        FAULT_TOLERANT: Nodes that are seen active. This works with few nodes, but with weaker guarantees.
    """

    CLASSIC = "classic"
    FAULT_TOLERANT = "fault_tolerant"


class RaftConfig:
    """Timeouts (ms), consensus variables and mode. Setters return the configuration itself."""

    def __init__(self) -> None:
        self._election_timeout_min = 150
        self._election_timeout_max = 300
        self._heartbeat_interval = 50
        self._consensus_variables: dict[str, type] = {}
        self._enable_logging = True
        self._log_level = "INFO"
        self._raft_mode = RaftMode.FAULT_TOLERANT
        self._failure_config = FailureConfig()
        self._failure_config.set_heartbeat_interval_reference(self._heartbeat_interval)

    def set_election_timeout(self, min_timeout: int, max_timeout: int) -> Self:
        """Set the range of the election timeout in ms. Each timeout is drawn from it at random.

        Raise ValueError if a bound is negative, or the lower one is not below the upper one.
        """
        for timeout in (min_timeout, max_timeout):
            checked_number("an election timeout", timeout, 0, infinite=True, unit="ms")
        if not min_timeout < max_timeout:
            raise ValueError(
                f"the shortest election timeout must be below the longest, got {min_timeout!r} and "
                f"{max_timeout!r} ms"
            )
        self._election_timeout_min = min_timeout
        self._election_timeout_max = max_timeout
        return self

    def set_heartbeat_interval(self, interval: int) -> Self:
        """Set the heartbeat interval of the leader in ms, also for the failure detection.

        Raise ValueError if it is <= 0, or the timeout of the failure detection would be shorter than 100 ms.
        """
        self._failure_config.set_heartbeat_interval_reference(interval)
        self._heartbeat_interval = interval
        return self

    def add_consensus_variable(self, name: str, var_type: type) -> Self:
        """Add a variable to agree on. All nodes should have the same variables.

        Its values must have a type that JSON preserves, such as int, float, str, bool, list and dict, or be
        tuples. Raise ValueError if the name is empty or taken, or the type is not a type.
        """
        if not isinstance(name, str) or not name:
            raise ValueError(
                f"the name of a consensus variable must be a string that is not empty, got {name!r}"
            )
        if name in self._consensus_variables:
            raise ValueError(f"the consensus variable {name!r} exists already")
        if not isinstance(var_type, type):
            raise ValueError(f"the type of the consensus variable {name!r} must be a type, got {var_type!r}")
        self._consensus_variables[name] = var_type
        return self

    def remove_consensus_variable(self, name: str) -> Self:
        """Remove a variable. Do nothing if there is no such variable."""
        self._consensus_variables.pop(name, None)
        return self

    def set_logging(self, enable: bool, level: str = "INFO") -> Self:
        """Enable or disable logging, and set the lowest level that is logged.

        Raise ValueError if the level is not DEBUG, INFO, WARNING, ERROR or CRITICAL.
        """
        if not isinstance(level, str) or level.upper() not in _LOG_LEVELS:
            raise ValueError(f"a log level is one of {', '.join(_LOG_LEVELS)}, got {level!r}")
        self._enable_logging = bool(enable)
        self._log_level = level.upper()
        return self

    def set_raft_mode(self, mode: RaftMode) -> Self:
        """Set the mode. Raise ValueError if it is not a `RaftMode`."""
        if not isinstance(mode, RaftMode):
            raise ValueError(f"mode must be RaftMode.CLASSIC or RaftMode.FAULT_TOLERANT, got {mode!r}")
        self._raft_mode = mode
        return self

    @property
    def election_timeout_min_ms(self) -> int:
        """Shortest election timeout in ms."""
        return self._election_timeout_min

    @property
    def election_timeout_max_ms(self) -> int:
        """Longest election timeout in ms."""
        return self._election_timeout_max

    @property
    def heartbeat_interval_ms(self) -> int:
        """Heartbeat interval of the leader in ms."""
        return self._heartbeat_interval

    @property
    def log_level(self) -> str | None:
        """Name of the lowest level that is logged, or None if logging is disabled."""
        return self._log_level if self._enable_logging else None

    def get_failure_config(self) -> FailureConfig:
        """Return the settings of the failure detection, which may be changed in place."""
        return self._failure_config

    def get_raft_mode(self) -> RaftMode:
        """Return the mode."""
        return self._raft_mode

    def is_classic_mode(self) -> bool:
        """Whether a majority of all known nodes is needed."""
        return self._raft_mode is RaftMode.CLASSIC

    def is_fault_tolerant_mode(self) -> bool:
        """Whether a majority of the nodes seen active is enough."""
        return self._raft_mode is RaftMode.FAULT_TOLERANT

    def get_random_election_timeout(self, stream: random.Random | None = None) -> int:
        """Draw an election timeout (integer, ms) from `stream`, or from Python's global one."""
        low, high = int(self._election_timeout_min), int(self._election_timeout_max)
        return (stream or random).randint(low, high)

    def get_consensus_variables(self) -> dict[str, type]:
        """Return the type of each variable."""
        return dict(self._consensus_variables)

    def has_consensus_variable(self, name: str) -> bool:
        """Whether there is a variable of that name."""
        return name in self._consensus_variables

    def get_consensus_variable_type(self, name: str) -> type | None:
        """Return the type of a variable, or None if there is no such variable."""
        return self._consensus_variables.get(name)

    def validate(self) -> list[str]:
        """Return the problems of the settings, one sentence each."""
        problems = []
        if not self._election_timeout_min < self._election_timeout_max:
            problems.append("the shortest election timeout must be below the longest")
        if not self._heartbeat_interval < self._election_timeout_min:
            problems.append(
                f"the heartbeat interval ({self._heartbeat_interval} ms) must be below the shortest election "
                f"timeout ({self._election_timeout_min} ms)"
            )
        if not self._consensus_variables:
            problems.append("there must be at least one consensus variable")
        return problems

    def to_dict(self) -> dict[str, Any]:
        """Return all settings as plain data. Types and the failure detection are strings."""
        return {
            "election_timeout_min": self._election_timeout_min,
            "election_timeout_max": self._election_timeout_max,
            "heartbeat_interval": self._heartbeat_interval,
            "consensus_variables": {name: kind.__name__ for name, kind in self._consensus_variables.items()},
            "enable_logging": self._enable_logging,
            "log_level": self._log_level,
            "raft_mode": self._raft_mode.value,
            "failure_config": str(self._failure_config),
            "heartbeat_timeout_multiplier": self._failure_config.get_timeout_multiplier(),
        }

    def __str__(self) -> str:
        return f"RaftConfig({self.to_dict()})"

    def __repr__(self) -> str:
        return (
            f"RaftConfig(election_timeout=({self._election_timeout_min}, {self._election_timeout_max}), "
            f"heartbeat_interval={self._heartbeat_interval}, "
            f"consensus_variables={list(self._consensus_variables)})"
        )
