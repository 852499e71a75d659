"""The timers of a node, with their durations: none of them is the same on two nodes for long."""

from gradysim.protocol.plugin.raft.environment import Environment
from gradysim.protocol.plugin.raft.raft_config import RaftConfig

ELECTION_TIMER = "election_timeout"
HEARTBEAT_TIMER = "heartbeat"
DISCOVERY_TIMER = "discovery_timeout"
REPLY_TIMER = "reply"

DISCOVERY_ROUNDS = 6
"""How often a node asks who is there.

The rounds take as long as the failure detection's timeout, or as the shortest election timeout if longer.
"""

_JITTER = (0.9, 1.1)
# Everybody answers a broadcast: not all at once. Of a heartbeat interval, and at most so many seconds.
_REPLY_SPREAD = 0.1
_REPLY_SPREAD_MAX_S = 0.005


class NodeTimers:
    """Sets the timers of one node; of each kind but replies there is at most one.

    Attributes:
        pending: Names of the timers that are set.
    """

    def __init__(self, config: RaftConfig, environment: Environment) -> None:
        self.pending: set[str] = set()
        self._config = config
        self._environment = environment

    def restart_election(self) -> None:
        """Wait for a leader's word for a time drawn from the range of the configuration."""
        low_ms, high_ms = self._config.election_timeout_min_ms, self._config.election_timeout_max_ms
        self._restart(ELECTION_TIMER, self._environment.random.uniform(low_ms, high_ms) / 1000)

    def restart_heartbeat(self) -> None:
        """Wait until the next heartbeat is due: the interval of the configuration, with jitter."""
        self._restart(HEARTBEAT_TIMER, self._config.heartbeat_interval_ms / 1000 * self._jitter())

    def restart_discovery_round(self) -> None:
        """Wait for answers, for one round."""
        all_ms = max(self._config.get_failure_config().get_timeout_ms(), self._config.election_timeout_min_ms)
        self._restart(DISCOVERY_TIMER, all_ms / 1000 / DISCOVERY_ROUNDS * self._jitter())

    def add_reply(self) -> None:
        """Wait a moment before one more reply."""
        spread_s = min(_REPLY_SPREAD * self._config.heartbeat_interval_ms / 1000, _REPLY_SPREAD_MAX_S)
        self.pending.add(REPLY_TIMER)
        self._environment.set_timer(REPLY_TIMER, self._environment.random.uniform(0, spread_s))

    def cancel(self, name: str) -> None:
        """Forget the timers of that name; no-op if there is none."""
        if name in self.pending:
            self.pending.discard(name)
            self._environment.cancel_timer(name)

    def _restart(self, name: str, delay_s: float) -> None:
        self.cancel(name)
        self.pending.add(name)
        self._environment.set_timer(name, delay_s)

    def _jitter(self) -> float:
        return self._environment.random.uniform(*_JITTER)
